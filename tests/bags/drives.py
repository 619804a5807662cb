# SPDX-License-Identifier: Apache-2.0
"""Recordings of a robot that drives in a circle, healthy or with one fault, written and compared by `rosbags`."""

from collections import Counter
from dataclasses import dataclass, field

import numpy as np
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Rosbag2Writer
from rosbags.typesys import Stores, get_typestore

SECOND = 1_000_000_000
MS = 1_000_000
START = 1_720_000_000 * SECOND
store = get_typestore(Stores.ROS2_HUMBLE)
URDF = """<robot name="rover">
  <link name="base_link"/>
  <link name="laser"/>
  <joint name="laser" type="fixed">
    <parent link="base_link"/> <child link="laser"/> <origin xyz="0.2 0 0.3"/>
  </joint>
</robot>"""
T = {name: store.types[f"{package}/msg/{name}"] for package, names in {
    "std_msgs": ["Header", "String"],
    "builtin_interfaces": ["Time", "Duration"],
    "geometry_msgs": ["Transform", "TransformStamped", "Vector3", "Quaternion", "Point", "Pose", "Twist",
                      "PoseWithCovariance", "TwistWithCovariance"],
    "tf2_msgs": ["TFMessage"],
    "nav_msgs": ["Odometry"],
    "sensor_msgs": ["Image", "Imu", "LaserScan", "CameraInfo", "RegionOfInterest"],
    "visualization_msgs": ["Marker", "MarkerArray"],
    "rosgraph_msgs": ["Clock"],
}.items() for name in names}  # fmt: skip


@dataclass
class Drive:
    """What is recorded; the defaults are healthy.

    `mounts` are the static transforms by child: the parent and x, y, z, qx, qy, qz, qw. `tf_shift` moves the stamps of
    odom -> base_link, `second` adds a second publisher of it, at another place.
    """

    mounts: dict = field(
        default_factory=lambda: {
            "laser": ("base_link", (0.2, 0.0, 0.3, 0.0, 0.0, 0.0, 1.0)),
            "camera": ("base_link", (0.25, 0.0, 0.4, 0.0, 0.0, 0.0, 1.0)),
            "camera_optical": ("camera", (0.0, 0.0, 0.0, -0.5, 0.5, -0.5, 0.5)),
        }
    )
    scan_frame: str = "laser"
    prefix: str = ""
    tf_shift: int = 0
    second: tuple = ()  # x, y offset of a second publisher of odom -> base_link
    repeats: bool = False  # whether each odom -> base_link is published twice
    seconds: int = 4


def header(at, frame):
    return T["Header"](stamp=T["Time"](sec=at // SECOND, nanosec=at % SECOND), frame_id=frame)


def transform(at, parent, child, values):
    x, y, z, *q = map(float, values)
    pose = T["Transform"](translation=T["Vector3"](x, y, z), rotation=T["Quaternion"](*q))
    return T["TransformStamped"](header=header(at, parent), child_frame_id=child, transform=pose)


def tf(*transforms):
    return T["TFMessage"](transforms=list(transforms))


def pose_at(at):
    angle = (at - START) / SECOND * 0.3
    return (2 * np.sin(angle), 2 - 2 * np.cos(angle), 0, 0, 0, np.sin(angle / 2), np.cos(angle / 2))


def events(drive):
    """Return (topic, receive time, message) of the drive, in receive order."""
    p = drive.prefix
    found = [("/robot_description", START - 60 * MS, T["String"](data=URDF))] if not p else []
    if drive.mounts:
        mounts = [transform(START, p + parent, p + child, values) for child, (parent, values) in drive.mounts.items()]
        found.append(("/tf_static", START - 50 * MS, tf(*mounts)))
    for at in range(START, START + drive.seconds * SECOND, 20 * MS):
        moved = transform(at + drive.tf_shift, p + "odom", p + "base_link", pose_at(at))
        found.append(("/tf", at + MS, tf(moved)))
        if drive.repeats:
            found.append(("/tf", at + 2 * MS, tf(moved)))
        if drive.second:
            x, y, *rest = pose_at(at + 7 * MS)
            other = (x + drive.second[0], y + drive.second[1], *rest)
            found.append(("/tf", at + 8 * MS, tf(transform(at + 7 * MS, p + "odom", p + "base_link", other))))
        found.append(("/tf", at + 3 * MS, tf(transform(at, "map", p + "odom", (1, 0, 0, 0, 0, 0, 1)))))
    for at in range(START + 100 * MS, START + drive.seconds * SECOND - 100 * MS, 100 * MS):
        found += [
            (f"/{p}scan", at + 5 * MS, scan(at, p + drive.scan_frame)),
            (f"/{p}image", at + 6 * MS, image(at, p + "camera_optical")),
            (f"/{p}odom", at + 4 * MS, odometry(at, p + "odom", p + "base_link")),
            (f"/{p}markers", at + 7 * MS, markers(at, p + "base_link")),
        ]
    return sorted(found, key=lambda event: event[1])


def scan(at, frame):
    ranges = np.full(90, 3.0, dtype=np.float32)
    return T["LaserScan"](header(at, frame), -1.5, 1.5, 3 / 89, 0.0, 0.1, 0.1, 10.0, ranges, np.empty(0, np.float32))


def image(at, frame):
    data = (np.arange(32 * 24) % 251).astype(np.uint8)
    return T["Image"](header(at, frame), 24, 32, "mono8", 0, 32, data)


def odometry(at, frame, child):
    x, y, z, *q = map(float, pose_at(at))
    pose = T["Pose"](T["Point"](x, y, z), T["Quaternion"](*q))
    still = T["Vector3"](0.0, 0.0, 0.0)
    return T["Odometry"](
        header(at, frame), child,
        T["PoseWithCovariance"](pose, np.zeros(36)), T["TwistWithCovariance"](T["Twist"](still, still), np.zeros(36)),
    )  # fmt: skip


def markers(at, frame):
    marker = store.types["visualization_msgs/msg/Marker"]
    values = {name: default(type_) for name, type_ in store.fielddefs["visualization_msgs/msg/Marker"][1]}
    return T["MarkerArray"]([marker(**{**values, "header": header(at, frame), "ns": "x"}) for _ in range(2)])


def default(type_):
    """Return the default value of a field, as rosbags describes its type."""
    kind, detail = type_
    if kind.name == "BASE":
        return "" if detail[0] == "string" else False if detail[0] == "bool" else 0
    if kind.name == "NAME":
        return store.types[detail](**{name: default(each) for name, each in store.fielddefs[detail][1]})
    return np.empty(0, np.uint8) if detail[0][0].name == "BASE" and detail[0][1][0] == "uint8" else []


_files = {}  # what has been written, by the name of the folder, the drive and the format


def write(path, drive, plugin=StoragePlugin.MCAP):
    """Write the drive as a folder of rosbag2; return its path."""
    key = path.name, repr(drive), plugin
    if key not in _files:
        _record(path, drive, plugin)
        _files[key] = {file.name: file.read_bytes() for file in path.iterdir()}
        return path
    path.mkdir(parents=True)
    for name, data in _files[key].items():
        (path / name).write_bytes(data)
    return path


def _record(path, drive, plugin):
    with Rosbag2Writer(path, version=9, storage_plugin=plugin) as writer:
        connections = {}
        for topic, at, message in events(drive):
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, message.__msgtype__, typestore=store)
            writer.write(connections[topic], at, store.serialize_cdr(message, message.__msgtype__))


def contents(path):
    """Return (topic, receive time, bytes) of all messages of a recording, as rosbags reads them."""
    with AnyReader([path]) as reader:
        return [(connection.topic, at, bytes(data)) for connection, at, data in reader.messages()]


def decoded(path, topic):
    """Return (receive time, message) of a topic, as rosbags decodes them."""
    with AnyReader([path]) as reader:
        chosen = [each for each in reader.connections if each.topic == topic]
        return [(at, reader.deserialize(data, each.msgtype)) for each, at, data in reader.messages(chosen)]


def connections(path):
    """Return the type, definition hash and QoS of each topic, as rosbags reads them."""
    with AnyReader([path]) as reader:
        return {
            each.topic: (each.msgtype, each.digest, str(each.ext.offered_qos_profiles)) for each in reader.connections
        }


def differences(old, new):
    """Return how many messages of each topic differ in two recordings with the same messages and times."""
    before, after = contents(old), contents(new)
    assert [each[:2] for each in before] == [each[:2] for each in after]
    return Counter(one[0] for one, other in zip(before, after, strict=True) if one[2] != other[2])
