# SPDX-License-Identifier: Apache-2.0
"""The types of recorded messages: their definitions are read, written and understood by other programs."""

import json
import random
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import recordings
from rosbags.interfaces import Nodetype
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

import coframe
from coframe.bags import Writer
from coframe.messages import deserialize, find, serialize
from coframe.messages.codec import deserialize_ros1
from coframe.messages.definition_texts import definition_of
from coframe.messages.packages import find_shipped, shipped_names
from coframe.messages.schema_classes import ResolvedSchema, SchemaClasses, known_class
from coframe.messages.schemas import parse_schema

START = recordings.START
noetic, humble = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.ROS2_HUMBLE)
SHIPPED = [
    f"{package}/msg/{name}"
    for package in shipped_names()
    for name in (find_shipped(package).names("msg") if "msg" in find_shipped(package).kinds() else [])
]
MEMBERS = [
    "turtlesim/action/RotateAbsolute_FeedbackMessage",
    "example_interfaces/srv/AddTwoInts_Request",
    "example_interfaces/srv/AddTwoInts_Event",
    "nav2_msgs/action/NavigateToPose_SendGoal_Request",
]


def class_of(text, ros_type, format_="ros2msg"):
    schema = ResolvedSchema(parse_schema(text, ros_type, format_))
    return SchemaClasses().of(schema, is_ros1=format_ == "ros1msg")


@pytest.mark.parametrize("ros_type", SHIPPED)
def test_written_definitions_are_those_of_the_class(ros_type):
    """Rosbags reads each as the fields of coframe's class, and coframe finds its own class again."""
    text = definition_of(ros_type)
    assert class_of(text.encode(), ros_type) is find(ros_type)
    cls = find(ros_type)
    types = get_types_from_msg(text, ros_type)
    fields = [name for name, _ in types[ros_type][1]]
    assert fields == [slot[1:] for slot in cls.__slots__] or fields == ["structure_needs_at_least_one_member"]
    names = {node[1] for _, node in types[ros_type][1] if node[0] == Nodetype.NAME}
    assert names <= {*types, "example_interfaces/msg/wstring"}  # which rosbags takes for a message


@pytest.mark.parametrize("ros_type", MEMBERS)
def test_messages_of_services_and_actions_have_definitions(ros_type):
    text = definition_of(ros_type)
    get_types_from_msg(text, ros_type)
    cls = class_of(text.encode(), ros_type)
    assert cls is known_class(ros_type)


def test_other_readers_open_recordings_of_all_packages(tmp_path, define_in):
    define_in(
        tmp_path,
        "pumps_msgs",
        Level="# in meters\nfloat64 depth 1.5\nstd_msgs/Header header\nTank[<=3] tanks\n",
        Tank="uint8 ROUND=1\nstring<=9 name\n",
    )
    types = [
        *("pumps_msgs/msg/Level", "turtlesim/msg/Pose", "control_msgs/msg/JointJog", "nav2_msgs/msg/Costmap"),
        *("vision_msgs/msg/Detection3DArray", "example_interfaces/msg/Float64", "map_msgs/msg/OccupancyGridUpdate"),
        *(
            "geographic_msgs/msg/GeoPoseStamped",
            "std_msgs/msg/Empty",
            "turtlesim/action/RotateAbsolute_FeedbackMessage",
        ),
    ]
    with Writer(tmp_path / "run") as writer:
        for number, name in enumerate(types):
            writer.write(writer.add_topic(f"/t{number}", name), serialize(find(name)()), START + number)
    assert writer.undescribed == []
    store = get_typestore(Stores.EMPTY)
    with Reader(tmp_path / "run") as reader:
        for connection in reader.connections:
            store.register(get_types_from_msg(connection.msgdef.data, connection.msgtype))
        read = {c.msgtype: store.deserialize_cdr(data, c.msgtype) for c, _, data in reader.messages()}
    assert read.keys() == set(types)
    assert read["pumps_msgs/msg/Level"].depth == 1.5
    schemas = {schema.name: schema for schema in schemas_of(next((tmp_path / "run").glob("*.mcap")))}
    assert schemas["pumps_msgs/msg/Level"].data.decode() == (
        "# in meters\nfloat64 depth 1.5\nstd_msgs/Header header\nTank[<=3] tanks\n\n"
        f"{'=' * 80}\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n\n"
        f"{'=' * 80}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n\n"
        f"{'=' * 80}\nMSG: pumps_msgs/Tank\nuint8 ROUND=1\nstring<=9 name\n"
    )


def schemas_of(path):
    from mcap.reader import make_reader

    with path.open("rb") as stream:
        return list(make_reader(stream).get_summary().schemas.values())


@pytest.fixture
def define_in(monkeypatch):
    """Write messages of a package, which is found by its path; it is forgotten at the end of the test."""
    from coframe.messages import packages, registry

    def define(folder, package, **messages):
        path = folder / package / "msg"
        path.mkdir(parents=True)
        for name, text in messages.items():
            (path / f"{name}.msg").write_text(text)
        monkeypatch.setenv("COFRAME_INTERFACES", str(folder / package))
        packages.forget()

    yield define
    packages.forget()
    for name in [name for name in registry.classes if name.startswith("pumps_msgs/")]:
        del registry.classes[name]
    definition_of.cache_clear()


def random_value(store, node, dice, depth=0):
    kind, detail = node
    if kind == Nodetype.NAME:
        return random_message(store, detail, dice, depth + 1)
    if kind == Nodetype.BASE:
        name = detail[0]
        if name == "string":
            return "".join(dice.choice("abc ü") for _ in range(dice.randrange(6)))
        if name == "bool":
            return dice.random() < 0.5
        dtype = np.dtype({"byte": "uint8", "char": "uint8"}.get(name, name))
        return dtype.type(dice.randrange(100)).item()
    inner, size = detail
    count = size if kind == Nodetype.ARRAY else dice.randrange(3)
    values = [random_value(store, inner, dice, depth + 1) for _ in range(count)]
    if inner[0] == Nodetype.BASE and inner[1][0] != "string":
        return np.array(values, dtype={"byte": "uint8", "char": "uint8"}.get(inner[1][0], inner[1][0]))
    return values


def random_message(store, name, dice, depth=0):
    fields = store.get_msgdef(name).fields
    return store.types[name](**{field: random_value(store, node, dice, depth) for field, node in fields})


NOETIC = sorted(name for name in noetic.fielddefs if name in humble.fielddefs)


@pytest.mark.parametrize("ros_type", NOETIC)
def test_messages_of_ros_1_are_decoded_as_rosbags_does(ros_type):
    dice = random.Random(ros_type)
    text, _ = noetic.generate_msgdef(ros_type, ros_version=1)
    cls = class_of(text.encode(), ros_type, "ros1msg")
    for _ in range(5):
        message = random_message(noetic, ros_type, dice)
        data = bytes(noetic.serialize_ros1(message, ros_type))
        if cls.__recorded__:
            decoded = deserialize_ros1(data, cls)
            assert [slot[1:] for slot in cls.__slots__] == [name for name, _ in noetic.get_msgdef(ros_type).fields]
            assert type(decoded) is cls
        else:
            own = serialize(deserialize_ros1(data, cls))
            assert own == bytes(humble.ros1_to_cdr(data, ros_type))


def test_all_but_the_messages_that_ros_2_changed_have_coframes_classes():
    changed = [
        name
        for name in NOETIC
        if class_of(noetic.generate_msgdef(name, ros_version=1)[0].encode(), name, "ros1msg").__recorded__
    ]
    assert len(NOETIC) > 100
    assert len(changed) < 0.2 * len(NOETIC), changed


def test_recorded_messages_are_of_one_kind(tmp_path):
    """A message of another definition can be published, shown and compared like every other one."""
    import coframe.messages
    from rosidl_runtime_py import message_to_yaml

    text = b"std_msgs/Header header\nfloat64 depth\nlab/Tank[] tanks\n" + b"=" * 80 + b"\nMSG: lab/Tank\nstring name\n"
    data = b"\0\1\0\0" + struct.pack("<iiI4xdII", 1, 2, 1, 0.5, 1, 3) + b"ab\0"
    types = {"/own": ("lab/msg/Level", "ros2msg", text, "cdr")}
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=[("/own", START, data)], types=types)
    (recorded,) = coframe.open_bag(path).messages("/own")
    message = recorded.message
    assert (recorded.stamp, message.depth, message.tanks[0].name) == (1_000_000_002, 0.5, "ab")
    assert "name: ab" in message_to_yaml(message)
    assert "lab/msg/Level" in message._repr_html_()
    assert serialize(message) == data
    assert deserialize(data, type(message)) == message
    assert isinstance(message, coframe.messages.Message)


def many_definitions(path, count, head="", type_="lab/msg/Own"):
    from mcap.writer import CompressionType, Writer

    with path.open("wb") as stream:
        writer = Writer(stream, compression=CompressionType.NONE, chunk_size=1 << 22)
        writer.start()
        for number in range(count):
            schema = writer.register_schema(type_, "ros2msg", f"{head}int32 x{number}\n".encode())
            channel = writer.register_channel(f"/t{number}/own", "cdr", schema)
            writer.add_message(channel, START + number, b"\0\1\0\0" + bytes(64), START)
        writer.finish()


PROGRAM = r"""
import re, sys, time
from pathlib import Path
import coframe
from coframe.bags.summary import summarize
from coframe.doctor import diagnose, observe_recording
with coframe.open_bag(sys.argv[1]) as recording:
    summarize(recording)
for observation in observe_recording(sys.argv[1]).values():
    diagnose(observation)
memory = int(re.search(r"VmHWM:\s+(\d+)", Path("/proc/self/status").read_text())[1]) // 1024
print(len(recording.topics), len(recording.problems), memory, time.process_time())
"""


@pytest.mark.skipif(sys.platform != "linux", reason="/proc")
@pytest.mark.parametrize(
    ("head", "type_"),
    [
        ("", "sensor_msgs/msg/JointState"),
        pytest.param("std_msgs/Header header\n", "lab/msg/Own", marks=pytest.mark.slow),
    ],
)
def test_ten_thousand_different_definitions_take_little_memory_and_time(tmp_path, head, type_):
    many_definitions(tmp_path / "a.mcap", 10_000, head, type_)
    shown = subprocess.run(
        [sys.executable, "-c", PROGRAM, tmp_path / "a.mcap"], capture_output=True, text=True, check=True
    ).stdout.split()
    topics, _, memory, seconds = int(shown[0]), int(shown[1]), int(shown[2]), float(shown[3])
    assert topics == 10_000
    assert memory < 250
    assert seconds < 20  # 3 on an idle machine


def test_definitions_have_limits_together(tmp_path, monkeypatch):
    from coframe.bags import _recorded_types as recorded_types
    from coframe.messages import schema_classes

    many_definitions(tmp_path / "a.mcap", 20)
    monkeypatch.setattr(recorded_types, "MAX_RECORDED_TEXT", 100)
    recording = coframe.open_bag(tmp_path / "a.mcap")
    decoded = [next(recording.messages(topic)).message for topic in recording.topics]
    assert sum(isinstance(message, bytes) for message in decoded) in range(10, 14)
    assert "the definitions of the recording exceed the maximum of 100 bytes" in recording.problems[-1]
    monkeypatch.undo()
    monkeypatch.setattr(schema_classes, "MAX_RECORDED_FIELDS", 10 * 21)
    recording = coframe.open_bag(tmp_path / "a.mcap")
    decoded = [next(recording.messages(topic)).message for topic in recording.topics]
    assert sum(isinstance(message, bytes) for message in decoded) == 10
    assert "exceed the maximum of 210 fields" in recording.problems[-1]


def test_one_unusable_definition_affects_its_topic_only(tmp_path):
    types = {
        "/good": ("lab/msg/Good", "ros2idl", b"module lab { module msg { struct Good { long x; }; }; };", "cdr"),
        "/bad": ("lab/msg/Bad", "ros2idl", b"\nconst long A = 1 << 30000000000;\n", "cdr"),
    }
    rows = [*recordings.messages(), *((topic, START, b"\0\1\0\0\7\0\0\0") for topic in types)]
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types=types)
    recording = coframe.open_bag(path)
    assert next(recording.messages("/good")).message.x == 7
    assert next(recording.messages("/bad")).message == b"\0\1\0\0\7\0\0\0"
    recordings.assert_same(recording.buffer)
    (problem,) = recording.problems
    assert problem.endswith("(line 2: a value is shifted by 30000000000 bits; the number of bits must be from 0 to 63)")
    shown = json.loads(
        subprocess.run(
            [Path(sys.executable).with_name("coframe"), "bag", "info", "--json", path],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
    )
    assert shown["problems"] == [problem]


DDS_TF = b"""module tf2_msgs { module msg { module dds_ {
  struct TFMessage_ { sequence<geometry_msgs::msg::dds_::TransformStamped_> transforms_; };
}; }; };
"""


@pytest.mark.parametrize("name", ["tf2_msgs::msg::dds_::TFMessage_", "tf2_msgs/TFMessage", "tf2_msgs::msg::TFMessage"])
def test_transforms_with_other_names_of_their_type(tmp_path, name):
    from coframe.bags.copying import copy_recordings

    kind = (name, "omgidl", DDS_TF, "cdr") if "dds_" in name else (name, "ros2msg", b"", "cdr")
    path = recordings.write_mcap(tmp_path / "a.mcap", types=dict.fromkeys(("/tf", "/tf_static"), kind))
    with coframe.open_bag(path) as recording:
        recordings.assert_same(recording.buffer)
        assert recording.topics["/tf"].type == recordings.TF
        assert type(next(recording.messages("/tf")).message) is find(recordings.TF)
    copy_recordings([path], tmp_path / "copy")
    with Reader(tmp_path / "copy") as reader:
        assert {connection.msgtype for connection in reader.connections} == {recordings.TF}
        assert all("string child_frame_id" in connection.msgdef.data for connection in reader.connections)
