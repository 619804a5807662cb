# SPDX-License-Identifier: Apache-2.0
"""The first inputs of each fuzz target: small valid samples by coframe, `mcap`, `rosbags` and by hand."""

from __future__ import annotations

import json
import math
import struct
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "bags"))

import numpy as np
import recordings
from recordings import START, walk
from rosbags.rosbag1.writer import Writer as Rosbag1Writer

import coframe
from coframe import _core
from coframe.bags._offered_qos import OfferedQos, to_yaml
from coframe.messages import find, serialize
from coframe.wire.rtps.discovery_info import NodeInfo, encode_info


def part(data: bytes) -> bytes:
    """Return bytes preceded by their length, as the native targets divide their inputs."""
    return struct.pack("<I", len(data)) + data


def transforms(encode: Callable[..., bytes], most: int = 4) -> list[bytes]:
    return [encode(parent, child, transform, at) for _, at, parent, child, transform in list(walk())[:most]]


def big_endian(parent: str, child: str, transform: coframe.Transform, at: int) -> bytes:
    body = struct.pack(">IiI", 1, *divmod(at, recordings.SECOND))
    for name in (parent, child):
        body += b"\0" * (-len(body) % 4) + struct.pack(">I", len(name) + 1) + name.encode() + b"\0"
    return b"\0\0\0\0" + body + b"\0" * (-len(body) % 8) + struct.pack(">7d", *transform.values)


def many(names: Iterable[str]) -> bytes:
    buffer = coframe.Buffer(None)
    for name in names:
        buffer.set("frame1/odom", name, coframe.Transform([1, 2, 3], [0, 0, 0, 1]), START)
    return buffer.encode(static=False)


def tf_message() -> Iterable[bytes]:
    cdr = [*transforms(recordings.cdr), *transforms(big_endian), many(["a", "größe", "frame2", "x" * 300])]
    yield from (b"\0" + data for data in cdr)
    yield from (b"\1" + data for data in transforms(recordings.ros1))


def ingest() -> Iterable[bytes]:
    several = many(["a", "größe", "frame2", "x" * 300])
    for options in (0, 1, 4, 8, 16, 33):
        yield bytes([options]) + b"".join(map(part, [*transforms(recordings.cdr), several]))
    yield b"\0" + b"".join(map(part, transforms(big_endian)))
    yield b"\2" + b"".join(map(part, transforms(recordings.ros1)))


def relay() -> Iterable[bytes]:
    for options in range(8):
        yield bytes([options]) + b"".join(
            bytes([i % 5, 30]) + part(data)
            for i, data in enumerate([*transforms(recordings.cdr, 8), many(["frame1/a", "frame2", "b"])])
        )


def moving(count: int) -> coframe.Buffer:
    buffer = coframe.Buffer(None)
    for i in range(count):
        buffer.set("odom", "base", coframe.Transform([i, 0, 0], [0, 0, 0, 1]), START + i * 20_000_000)
    buffer.set("base", "lidar", coframe.Transform([0, 0, 1], [0, 0, 0, 1]), START, static=True)
    return buffer


def frozen() -> Iterable[bytes]:
    for count in (3, 300):
        snapshot = moving(count).snapshot()
        table, chunks = _core.frozen_parts(snapshot)
        yield part(table) + _core.frozen_chunks(snapshot, 0, chunks)


def recording_files(write: Callable[[Path], object]) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "recording"
        write(path)
        if path.is_dir():
            path = next(file for file in path.iterdir() if file.name != "metadata.yaml")
        return path.read_bytes()


def short_rows(encode: Callable[..., bytes] = recordings.cdr) -> list[tuple[str, int, bytes]]:
    return recordings.messages(encode)[:6]


def mcap() -> Iterable[bytes]:
    kinds = recordings.CompressionType
    schemas = {
        "/tf": (
            "lab/msg/Own",
            "ros2msg",
            b"\n".join(
                [b"string<=4 s", b"float64[] x", b"lab/P[2] p", b"=" * 16, b"MSG: lab/P", b"int8 a", b"wstring b"]
            ),
            "cdr",
        ),
        "/tf_static": ("foxglove.FrameTransform", "jsonschema", b"{}", "json"),
    }
    foxglove = [(t, at, recordings.foxglove_json(*facts, at)) for t, at, *facts in list(walk())[:2]]
    protobuf = [(t, at, recordings.foxglove_protobuf(*facts, at)) for t, at, *facts in list(walk())[:2]]
    binary = ("foxglove.FrameTransform", "protobuf", recordings.foxglove_protobuf_definition(), "protobuf")
    for options in (
        {"compression": kinds.ZSTD},
        {"compression": kinds.LZ4},
        {"compression": kinds.NONE},
        {"chunked": False},
        {"compression": kinds.NONE, "finish": False},
        {"compression": kinds.NONE, "types": schemas},
        {"compression": kinds.NONE, "types": {"/tf": schemas["/tf_static"]}, "rows": foxglove},
        {"compression": kinds.NONE, "types": {"/tf": binary}, "rows": protobuf},
    ):
        yield recording_files(
            lambda path, options=options: recordings.write_mcap(path, **{"rows": short_rows(), **options})
        )


def repair() -> Iterable[bytes]:
    yield from mcap()


def frozen_file() -> Iterable[bytes]:
    for count in (3, 300):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "buffer.cfz"
            moving(count).save(path)
            yield path.read_bytes()


def mcap_records() -> Iterable[bytes]:
    message = struct.pack("<BQHIQQ", 5, 25, 1, 7, START, START) + b"abc"
    channel = struct.pack("<BQ", 4, 5) + b"12345"
    yield channel + message * 3
    yield message + struct.pack("<BQ", 0x80, 3) + b"own" + message[:-1]
    yield from mcap()


def sqlite() -> Iterable[bytes]:
    for version in (1, 4):
        yield recording_files(
            lambda path, version=version: recordings.write_sqlite(path / "walk.db3", version, short_rows())
        )


def ros1_bag() -> Iterable[bytes]:
    for compression in (None, Rosbag1Writer.CompressionFormat.BZ2, Rosbag1Writer.CompressionFormat.LZ4):
        yield recording_files(
            lambda path, compression=compression: recordings.write_rosbag1(
                path, compression, short_rows(recordings.ros1)
            )
        )


def metadata() -> Iterable[bytes]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "walk"
        recordings.write_rosbag2(path, rows=short_rows())
        yield (path / "metadata.yaml").read_bytes()
    yield to_yaml([OfferedQos(), OfferedQos(5, False, True, True)]).encode()


def messages() -> Iterable[bytes]:
    from python_targets import MESSAGE_TYPES

    for number, name in enumerate(MESSAGE_TYPES):
        message = find(name)()
        yield bytes([number]) + serialize(message)
        if hasattr(message, "header"):
            message.header.frame_id = "base"
            yield bytes([number]) + serialize(message)
    yield bytes([MESSAGE_TYPES.index("tf2_msgs/msg/TFMessage")]) + many(["a", "b"])


def displays() -> Iterable[bytes]:
    from python_targets import displayed_types

    yield from _sensor_seeds(displayed_types())


def sensor_messages() -> Iterable[bytes]:
    from python_targets import SENSOR_TYPES

    yield from _sensor_seeds(SENSOR_TYPES)


def _sensor_seeds(names: Sequence[str]) -> Iterable[bytes]:
    """Return a message of each type with some content, preceded by the number of its type."""
    field = find("sensor_msgs/msg/PointField")
    cloud = [field(name=name, offset=4 * i, datatype=7, count=1) for i, name in enumerate(("x", "y", "z", "intensity"))]
    png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII5BI", 13, b"IHDR", 4, 3, 8, 2, 0, 0, 0, 0)
    jpeg = b"\xff\xd8\xff\xe0\0\4JF\xff\xc0\0\x0b\x08\0\3\0\4\1\1\x11\0\xff\xd9"
    marker, pose = find("visualization_msgs/msg/Marker"), find("geometry_msgs/msg/Pose")
    contents = {
        "geometry_msgs/msg/PoseArray": [{"poses": [pose(), pose()]}],
        "nav_msgs/msg/OccupancyGrid": [{"data": [-1, 0, 100, 50, 1, 2]}],
        "nav_msgs/msg/Path": [{"poses": [find("geometry_msgs/msg/PoseStamped")()]}],
        "sensor_msgs/msg/CameraInfo": [{"height": 3, "width": 4, "distortion_model": "plumb_bob", "d": [0.1] * 5}],
        "sensor_msgs/msg/CompressedImage": [{"format": "png", "data": png}, {"format": "jpeg", "data": jpeg}],
        "sensor_msgs/msg/Image": [
            {"height": 2, "width": 2, "encoding": encoding, "step": 2 * size, "data": bytes(4 * size)}
            for encoding, size in (("rgb8", 3), ("bgra8", 4), ("mono16", 2), ("32FC1", 4), ("bayer_rggb8", 1))
        ],
        "sensor_msgs/msg/LaserScan": [{"angle_increment": 0.1, "range_max": 9.0, "ranges": [1.0, 2.0, 3.0]}],
        "sensor_msgs/msg/PointCloud2": [
            {"height": 1, "width": 2, "fields": cloud, "point_step": 16, "row_step": 32, "data": bytes(range(32))}
        ],
        "visualization_msgs/msg/Marker": [{"type": kind, "ns": "lab", "text": "hello"} for kind in range(12)],
        "visualization_msgs/msg/MarkerArray": [{"markers": [marker(id=1), marker(id=2, type=4), marker(action=3)]}],
    }
    for number, name in enumerate(names):
        for fields in contents.get(name, [{}]):
            message = find(name)(**fields)
            if name == "nav_msgs/msg/OccupancyGrid":
                message.info.width, message.info.height, message.info.resolution = 3, 2, 0.5
            yield bytes([number]) + serialize(message)


def definitions() -> Iterable[bytes]:
    yield b"m# a comment\nstd_msgs/Header header\nint32 X=3\nstring<=5 name 'a'\nfloat64[<=9] v [1.5, 2]\nuint8[4] d\n"
    yield b"m" + b'int32 a\n---\nbool b true\nstring t "x\\"y"\n'
    yield b"ibool a\n"
    yield (
        b"imodule lab { module msg { const long N = 3; typedef double v[3]; enum E { A, B };\n"
        b'@verbatim (language="comment", text="x") struct P { @default (value=3) long a;\n'
        b"sequence<string<5>, 2> s; v w; }; }; };"
    )


def schemas() -> Iterable[bytes]:
    line, end = b"=" * 80 + b"\n", b"\0\0\0\0" + bytes(range(1, 61))
    text = b"std_msgs/Header header\nlab/Q[<=2] q\nwstring w\nfloat64[3] v\n" + line + b"MSG: lab/Q\nbyte b\nstring s\n"
    yield b"\0" + text + end
    yield b"\0" + line + b"SRV: lab/srv/P\nint64 a\n---\nbool[] b\n" + line + b"MSG: lab/P\nP_Request[] r\n" + end
    yield (
        b"\1int32 low=3\nHeader header\ntime t\nduration[2] d\nQ[] q\n" + line + b"MSG: lab/Q\nchar[] c\nbool b\n" + end
    )
    idl = b"module lab { module msg { module P_Constants { const long A = (1 << 4) + ~2 * 3 / 7; };\n"
    idl += b'typedef double v[3]; @verbatim (language="comment", text="x") struct P { @default (value=3) long a;\n'
    idl += b"sequence<string<5>, 2 * 3> s; v w; lab::msg::Q q; }; }; };\n"
    yield (
        b"\2"
        + line
        + b"IDL: lab/msg/P\n"
        + idl
        + line
        + (b'IDL: lab/msg/Q\n#include "x.idl"\nmodule lab { module msg { struct Q { octet o; }; }; };' + end)
    )
    yield (
        b"\4module lab { module msg { module dds_ {\n"
        b"struct P_ { std_msgs::msg::dds_::Header_ header_; char c_; }; }; }; };" + end
    )
    descriptor = (
        "0a310a076c2e70726f746f12036c616222190a015012090a017818012001280512090a0179180220032809620670726f746f33"
    )
    yield b"\3" + bytes.fromhex(descriptor) + end


def discovery() -> Iterable[bytes]:
    nodes = [NodeInfo("/", "talker", (bytes(range(16)),), (bytes(16), bytes(range(16)))), NodeInfo("/robot", "größe")]
    for size in (16, 24):
        yield encode_info(bytes(range(1, 17)), nodes, size)
        yield encode_info(bytes(16), [], size)
    yield b"typehash=RIHS01_" + b"a0" * 32 + b";enclave=/;"


ARM = """<?xml version="1.0"?>
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="base"><visual><origin xyz="0 0 1" rpy="0 0.5 0"/><geometry><box size="1 2 3"/></geometry>
    <material name="red"/></visual><collision><geometry><mesh filename="package://lab/a.stl" scale="1 1 1"/></geometry>
    </collision><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="upper"><visual><geometry><cylinder radius="0.1" length="1"/></geometry></visual></link>
  <link name="tip"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="upper"/><child link="tip"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="turn" multiplier="2" offset="0.1"/></joint>
</robot>
"""


def urdf() -> Iterable[bytes]:
    yield ARM.encode()
    yield ARM.replace('<?xml version="1.0"?>', '<?xml version="1.0" encoding="latin-1"?>').encode("latin-1")
    yield ARM.encode("utf-16")


def xacro() -> Iterable[bytes]:
    yield ARM.replace(
        "</robot>",
        """<xacro:property name="n" value="${2 * 3}"/><xacro:arg name="a" default="1"/>
        <xacro:macro name="part" params="name *origin size:=^|2"><link name="${name}_${size}"/>
        <xacro:if value="${n > 3}"><xacro:insert_block name="origin"/></xacro:if></xacro:macro>
        <xacro:part name="x$(arg a)"><origin xyz="0 0 ${n}"/></xacro:part></robot>""",
    ).encode()


def rviz() -> Iterable[bytes]:
    yield b"""Panels: []
Visualization Manager:
  Class: ""
  Displays:
    - {Alpha: 0.5, Class: rviz_default_plugins/Grid, Enabled: true, Name: Grid, Cell Size: 1, Color: 160; 160; 164}
    - {Class: rviz_default_plugins/TF, Enabled: true, Name: TF, Frame Timeout: 15, Frames: {All Enabled: true}}
    - Class: rviz_common/Group
      Displays:
        - Class: rviz_default_plugins/LaserScan
          Topic: {Depth: 5, Value: /scan, Reliability Policy: Best Effort, Durability Policy: Volatile}
          Size (m): 0.01
      Enabled: true
      Name: Group
  Global Options: {Background Color: 48; 48; 48, Fixed Frame: odom, Frame Rate: 30}
  Tools: [{Class: rviz_default_plugins/SetGoal, Topic: {Value: /goal_pose}}]
  Views:
    Current: {Class: rviz_default_plugins/Orbit, Distance: 10, Focal Point: {X: 0, Y: 0, Z: 0}, Pitch: 0.5, Yaw: 0.7}
"""


def mesh_names() -> Iterable[bytes]:
    for name in ("package://lab/meshes/a.stl", "file:///tmp/a%20b.dae", "a/../b.obj", "http://x/a.stl", "a.stl\0x"):
        yield name.encode()


def viewer_messages() -> Iterable[bytes]:
    frames = [
        {"type": "ready", "drawn": 1.5},
        {"type": "set_fixed_frame", "frame": "odom"},
        {"type": "subscribe", "topic": "/tf"},
        {"type": "relate", "target": "odom", "source": "base"},
        {"type": "set_time", "time": 2.5},
        {"type": "explain", "code": "TF001"},
        {"type": "load_rviz", "text": next(iter(rviz())).decode()},
    ]
    from typing import get_args

    from coframe.viewer.protocol.client_messages import ClientMessage
    from coframe.viewer.protocol.schema import record

    frames += [
        {"type": one.type, **{part.name: 1 for part in record(one).fields if part.name != "type"}}
        for one in get_args(ClientMessage)
    ]
    yield from (json.dumps(fields).encode() for fields in frames)
    yield "\n".join(map(json.dumps, frames)).encode()


def viewer_socket() -> Iterable[bytes]:
    host = b"Host: 127.0.0.1:7676\r\n"
    yield b"GET / HTTP/1.1\r\n" + host + b"\r\n"
    yield b"GET /assets/page.js?x=%2e%2e HTTP/1.1\r\n" + host + b'If-None-Match: "x"\r\n\r\n'
    yield b"POST /mesh/x/../y HTTP/1.1\r\n" + host + b"Content-Length: 3\r\n\r\nabc"
    opening = (
        b"GET /ws HTTP/1.1\r\n" + host + b"Upgrade: websocket\r\nConnection: Upgrade\r\n"
        b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"
    )
    frames = b"".join(websocket_frame(data) for data in list(viewer_messages())[:5])
    yield opening + frames
    yield opening + websocket_frame(b"{", opcode=1, final=False) + websocket_frame(b"}", opcode=0)
    yield opening + websocket_frame(b"ping", opcode=9) + websocket_frame(b"\x03\xe8bye", opcode=8)


def websocket_frame(data: bytes, opcode: int = 1, *, final: bool = True) -> bytes:
    length = len(data)
    size = bytes([0x80 | length]) if length < 126 else b"\xfe" + struct.pack(">H", length)
    return bytes([0x80 * final | opcode]) + size + bytes(4) + data


def launch_xml() -> Iterable[bytes]:
    yield b"""<launch><arg name="a" default="1" description="x"/><let name="b" value="$(var a)$(env HOME x)"/>
<group if="$(eval '1 + 1 == 2')"><push_ros_namespace namespace="r"/>
<node pkg="lab" exec="listener" name="n" args="--x $(var b)" output="screen"><param name="p" value="1.5"/>
<param name="l" value="1;2" value-sep=";"/><remap from="/a" to="/b"/><env name="E" value="1"/></node></group>
<executable cmd="ls $(dirname)" shell="false"/><set_env name="X" value="$(find-pkg-share lab)"/>
<include file="$(dirname)/x.launch.py"><arg name="q" value="$(anon n)"/></include><timer period="1.0"/></launch>"""


def launch_yaml() -> Iterable[bytes]:
    yield b"""launch:
- arg: {name: a, default: '1'}
- let: {name: b, value: $(var a)}
- group:
  - push_ros_namespace: {namespace: r}
  - node: {pkg: lab, exec: listener, name: n, param: [{name: p, value: 1.5}], remap: [{from: /a, to: /b}]}
- executable: {cmd: ls $(dirname), shell: 'false'}
- include: {file: x.launch.py, arg: [{name: q, value: $(anon n)}]}
"""


def parameters() -> Iterable[bytes]:
    yield (
        b"/**:\n  ros__parameters:\n    a: 1\n    b: [1.5, .5, 1e5]\n    c: {d: 'x', e: [a, b]}\n"
        b"/r/n:\n  ros__parameters: {f: yes}\n"
    )
    yield b"[1, 2.5, 'x']"


def trajectories() -> Iterable[bytes]:
    rows = [(START / 1e9 + i / 20, math.cos(i), math.sin(i), 0, 0, 0, 0, 1) for i in range(4)]
    yield "".join(" ".join(map(str, row)) + "\n" for row in rows).encode()
    yield b"# t x y z qx qy qz qw\n" + ",".join(map(str, rows[0])).encode()
    yield b"#timestamp, p_x, p_y, p_z, q_w, q_x, q_y, q_z\n" + b"1403636580838555648,1,2,3,1,0,0,0\n" * 3
    yield b"stamp,x,y,z,qx,qy,qz,qw\n" + b"1.5,1,2,3,0,0,0,1\n" * 3
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "path.npz"
        poses = coframe.Transform(np.zeros((3, 3)), stamp=np.arange(3), target="map", source="base")
        coframe.trajectories.write_trajectory(poses, file)
        yield file.read_bytes()
