# SPDX-License-Identifier: Apache-2.0
"""Bags of ROS 1 with types that ROS 2 does not have, or has with other fields, as recordings of ROS 2."""

import os
import struct
import subprocess
import sys

import pytest
import recordings
from recordings import START
from rosbags.highlevel import AnyReader
from rosbags.rosbag1 import Writer as Rosbag1Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

import coframe
from coframe.bags import repair
from coframe.bags.copying import copy_recordings

WHEEL = """
Header header
time last_service
float64[2] slip
WheelPart[] parts
string MODEL=wheel
uint8 left=1
uint8 D
================================================================================
MSG: my_robot/WheelPart
string name
duration age
"""


def bag(path, ros_type, definition, data):
    """Write a bag of ROS 1 with one message on /own, and the walk."""
    with Rosbag1Writer(path) as writer:
        own = writer.add_connection("/own", ros_type, msgdef=definition, md5sum="0" * 32)
        writer.write(own, START, data)
        tf = {}
        for topic, at, message in recordings.messages(recordings.ros1):
            if topic not in tf:
                tf[topic] = writer.add_connection(topic, recordings.TF, typestore=recordings.humble)
            writer.write(tf[topic], at, message)
    return path


def text(value):
    return struct.pack("<I", len(value)) + value


def wheel_bag(path):
    parts = struct.pack("<I", 1) + text(b"hub") + struct.pack("<ii", 5, 6)
    header = struct.pack("<III", 7, 1_700_000_000, 0) + text(b"wheel")
    return bag(path, "my_robot/msg/Wheel", WHEEL, header + struct.pack("<II2d", 3, 4, 0.5, 0.25) + parts + b"\x09")


def copy(source, target):
    return copy_recordings([source], target)


@pytest.mark.parametrize("write", [copy, repair])
def test_a_type_of_the_team_itself_is_converted_with_its_definition(tmp_path, write):
    report = write(wheel_bag(tmp_path / "run.bag"), tmp_path / "run")
    assert report.problems == []
    with coframe.open_bag(tmp_path / "run") as recording:
        message = next(recording.messages("/own")).message
        assert recording.topics["/own"].type == "my_robot/msg/Wheel"
        assert (message.header.frame_id, message.last_service.sec, message.D) == ("wheel", 3, 9)
        assert (message.MODEL, message.LEFT) == ("wheel", 1)
        assert [(part.name, part.age.nanosec) for part in message.parts] == [("hub", 6)]
        recordings.assert_same(recording.buffer)
    with AnyReader([tmp_path / "run"]) as reader:  # an independent program that knows only what the file contains
        (connection,) = [each for each in reader.connections if each.topic == "/own"]
        ((_, _, data),) = reader.messages([connection])
        other = reader.deserialize(data, connection.msgtype)
    assert (other.header.frame_id, other.last_service.sec, other.D) == ("wheel", 3, 9)
    assert (list(other.slip), other.parts[0].name) == ([0.5, 0.25], "hub")


MARKER = """
Header header
string ns
int32 id
int32 type
int32 action
geometry_msgs/Pose pose
geometry_msgs/Vector3 scale
std_msgs/ColorRGBA color
duration lifetime
bool frame_locked
geometry_msgs/Point[] points
std_msgs/ColorRGBA[] colors
string text
string mesh_resource
bool mesh_use_embedded_materials
"""


def marker():
    """Return a visualization_msgs/MarkerArray of ROS 1, whose markers have fewer fields than those of ROS 2."""
    header = struct.pack("<III", 7, 1_700_000_000, 0) + text(b"map")
    numbers = struct.pack("<iii7d3d4f", 3, 1, 0, *range(1, 8), 1, 2, 3, 0, 1, 0, 1)
    rest = struct.pack("<ii?", 5, 0, True) + struct.pack("<I3d", 1, 1, 2, 3) + struct.pack("<I", 0)
    return struct.pack("<I", 1) + header + text(b"zone") + numbers + rest + text(b"hi") + text(b"") + b"\0"


def test_a_type_with_new_fields_in_ros2_gets_their_defaults(tmp_path):
    definition = f"visualization_msgs/Marker[] markers\n{'=' * 80}\nMSG: visualization_msgs/Marker{MARKER}"
    source = bag(tmp_path / "run.bag", "visualization_msgs/msg/MarkerArray", definition, marker())
    assert copy(source, tmp_path / "run").problems == []
    store = get_typestore(Stores.ROS2_HUMBLE)
    with AnyReader([tmp_path / "run"], default_typestore=recordings.humble) as reader:
        (connection,) = [each for each in reader.connections if each.topic == "/own"]
        ((_, _, data),) = reader.messages([connection])
        assert connection.msgtype == "visualization_msgs/msg/MarkerArray"
        (found,) = store.deserialize_cdr(data, connection.msgtype).markers
    assert (found.header.frame_id, found.ns, found.id, found.text) == ("map", "zone", 3, "hi")
    assert (found.pose.position.z, found.points[0].y, found.lifetime.sec) == (3.0, 2.0, 5)
    assert list(found.mesh_file.data) == []


@pytest.mark.parametrize(
    ("ros_type", "definition"),
    [
        ("std_msgs/msg/String", "string data\nint32 color"),  # a field that ROS 2 does not have
        ("my_robot/msg/Wheel", "Missing missing"),
    ],
)
def test_a_type_that_cannot_be_converted_is_reported(tmp_path, ros_type, definition):
    source = bag(tmp_path / "run.bag", ros_type, definition, text(b"a") + bytes(4))
    assert "/own: 1 message skipped, because their ROS 1 type cannot" in " ".join(
        repair(source, tmp_path / "new").changes
    )
    report = copy(source, tmp_path / "run")
    assert report.problems[-1].startswith("/own: 1 message could not be converted")
    with coframe.open_bag(tmp_path / "run") as recording:
        recordings.assert_same(recording.buffer)


def test_sqlite_recordings_contain_definitions(tmp_path):
    """As those of Iron and later; rosbags, which knows none of the types, decodes the messages."""
    from coframe.messages import find, serialize

    kinds = ("control_msgs/msg/DynamicJointState", "my_robot/msg/Own")
    state = find(kinds[0])(joint_names=["elbow"])
    with coframe.bags.Writer(tmp_path / "run", storage="sqlite3") as writer:
        for name in ("/one", "/two"):
            writer.write(writer.add_topic(name, kinds[0]), serialize(state), START)
        own = writer.add_topic("/own", kinds[1], definition="float64 speed", definition_format="ros2msg")
        writer.write(own, b"\0\1\0\0" + struct.pack("<d", 2.5), START + 1)
        writer.write(writer.add_topic("/raw", "my_robot/msg/Unknown"), b"\0\1\0\0", START + 2)
    assert writer.undescribed == ["my_robot/msg/Unknown"]
    with coframe.open_bag(tmp_path / "run") as recording:
        channels = {channel.topic: channel for channel in recording.channels()}
        definitions = {topic: (each.definition_format, each.definition) for topic, each in channels.items()}
        assert definitions["/own"] == ("ros2msg", b"float64 speed")
        assert definitions["/raw"] == ("", b"")
        assert next(recording.messages("/own")).message.speed == 2.5
        assert next(recording.messages("/two")).message == state
    types = get_types_from_msg("float64 speed", kinds[1])
    store = get_typestore(Stores.EMPTY)
    store.register(types)
    with AnyReader([tmp_path / "run"]) as reader:
        decoded = {
            connection.topic: reader.deserialize(data, connection.msgtype)
            for connection, _, data in reader.messages(
                [each for each in reader.connections if each.topic in {"/one", "/own"}]
            )
        }
    assert decoded["/one"].joint_names == ["elbow"]
    assert decoded["/own"].speed == 2.5


IDL = {
    "Pump.idl": """
#include "pumps/msg/Rotor.idl"
#include "std_msgs/msg/Header.idl"
module pumps { module msg {
  typedef double Curve[3];
  module Pump_Constants { const uint8 idle = 2; const string maker = "a \\"b\\""; };
  @verbatim (language="comment", text="A pump.")
  struct Pump {
    std_msgs::msg::Header header;
    Curve curve;
    sequence<pumps::msg::Rotor, 4> rotors;
    octet raw;
    @default (value=7) long Speed;
    string<9> name;
  };
}; };
""",
    "Rotor.idl": "module pumps { module msg { struct Rotor { boolean turns; unsigned long long ticks; }; }; };",
}


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_recording_of_idl_types_is_read_without_the_files(tmp_path, storage):
    folder = tmp_path / "pumps" / "msg"
    folder.mkdir(parents=True)
    for name, definition in IDL.items():
        (folder / name).write_text(definition)
    program = """
import sys
from coframe.bags import Writer
from coframe.messages import find, serialize
Pump, Rotor = find("pumps/msg/Pump"), find("pumps/msg/Rotor")
message = Pump(curve=[1.0, 2.0, 3.0], rotors=[Rotor(turns=True, ticks=1 << 40)], name="p1", raw=b"\\x05")
with Writer(sys.argv[1], storage=sys.argv[2]) as writer:
    writer.write(writer.add_topic("/pump", "pumps/msg/Pump"), serialize(message), 5)
assert writer.undescribed == []
"""
    environment = {**os.environ, "COFRAME_INTERFACES": str(tmp_path)}
    subprocess.run([sys.executable, "-c", program, tmp_path / "run", storage], env=environment, check=True)
    with coframe.open_bag(tmp_path / "run") as recording:
        message = next(recording.messages("/pump")).message
        assert recording.problems == []
    assert (list(message.curve), message.Speed, message.name, message.raw) == ([1, 2, 3], 7, "p1", b"\x05")
    assert (message.rotors[0].turns, message.rotors[0].ticks, message.IDLE, message.MAKER) == (
        True,
        1 << 40,
        2,
        'a "b"',
    )
    with AnyReader([tmp_path / "run"]) as reader:
        ((connection, _, data),) = reader.messages()
        other = reader.deserialize(data, connection.msgtype)
    assert (list(other.curve), other.Speed, other.rotors[0].ticks, other.name) == ([1, 2, 3], 7, 1 << 40, "p1")
