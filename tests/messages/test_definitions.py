# SPDX-License-Identifier: Apache-2.0
"""The definitions equal those of ROS 2 Jazzy, the default, and the generated classes are up to date."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_typestore

from coframe.messages import find
from coframe.messages._parser import parse
from coframe.messages.definition import (
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    NamespacedType,
    UnboundedSequence,
    UnboundedString,
)

ROOT = Path(__file__).resolve().parents[2]
INTERFACES = ROOT / "interfaces"
IDL = {"bool": "boolean", "byte": "octet", "char": "uint8", "float32": "float", "float64": "double"}

# Messages that rosbags does not have for Jazzy: Goals was added to Jazzy later, the others came with Lyrical.
LATER = {
    "nav_msgs/msg/Goals",
    "nav_msgs/msg/Trajectory",
    "nav_msgs/msg/TrajectoryPoint",
    "rosbag2_interfaces/msg/MessagesLostEvent",
    "rosbag2_interfaces/msg/MessagesLostEventTopicStat",
    *(f"rosgraph_msgs/msg/{name}" for name in ("Action", "Graph", "InterfaceType", "Node", "QoSProfile", "Service")),
    *(f"rosgraph_msgs/msg/{name}" for name in ("Topic", "TypeHash")),
}

SERVICES = {
    "action_msgs": {"CancelGoal"},
    "nav_msgs": {"GetMap", "GetPlan", "LoadMap", "SetMap"},
    "rcl_interfaces": {
        "DescribeParameters",
        "GetLoggerLevels",
        "GetParameters",
        "GetParameterTypes",
        "ListParameters",
        "SetLoggerLevels",
        "SetParameters",
        "SetParametersAtomically",
    },
    "sensor_msgs": {"SetCameraInfo"},
    "std_srvs": {"Empty", "SetBool", "Trigger"},
    "tf2_msgs": {"FrameGraph"},
    "visualization_msgs": {"GetInteractiveMarkers"},
}


def our_type(node: Any) -> Any:
    kind, facts = node
    if kind == Nodetype.NAME:
        package, _, name = facts.split("/")
        return NamespacedType((package, "msg"), name)
    if kind == Nodetype.BASE:
        name, bound = facts
        if name == "string":
            return BoundedString(bound) if bound else UnboundedString()
        return BasicType(IDL.get(name, name))
    inner, size = facts
    if kind == Nodetype.ARRAY:
        return Array(our_type(inner), size)
    return BoundedSequence(our_type(inner), size) if size else UnboundedSequence(our_type(inner))


@pytest.fixture(scope="module")
def jazzy() -> dict[str, Any]:
    """Return the definitions that rosbags has of Jazzy, of packages that coframe has."""
    packages = {path.name for path in INTERFACES.iterdir()}
    definitions = get_typestore(Stores.ROS2_JAZZY).fielddefs
    return {name: facts for name, facts in definitions.items() if name.split("/")[0] in packages}


def test_no_message_of_the_packages_is_missing(jazzy: dict[str, Any]) -> None:
    packages = {name.split("/")[0] for name in jazzy}
    ours = {f"{path.parts[-3]}/msg/{path.stem}" for path in INTERFACES.glob("*/msg/*.msg")}
    assert {name for name in ours if name.split("/")[0] in packages} == {*jazzy, *LATER}


def test_messages_have_the_fields_and_constants_of_jazzy(jazzy: dict[str, Any]) -> None:
    for ros_type, (constants, fields) in jazzy.items():
        cls = find(ros_type)
        expected = [(name, our_type(node)) for name, node in fields if name != "structure_needs_at_least_one_member"]
        assert [(slot[1:], type_) for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True)] == expected, (
            ros_type
        )
        for name, type_name, value in constants:
            assert getattr(cls, name) == (bytes([value]) if type_name == "byte" else value), (ros_type, name)


def test_definitions_are_those_of_the_ros_packages(shared: Path) -> None:
    for name, lines in json.loads((shared / "interfaces.json").read_text("utf-8")).items():
        package, kind, own = name.split("/")
        assert (INTERFACES / package / kind / f"{own}.{kind}").read_text("utf-8").splitlines() == lines, name


@pytest.mark.parametrize("package", SERVICES)
def test_services_are_complete(package: str) -> None:
    assert {path.stem for path in (ROOT / "interfaces" / package / "srv").iterdir()} == SERVICES[package]
    for name in SERVICES[package]:
        service = find(f"{package}/srv/{name}")
        assert f"{package}/srv/{name}_Request" == service.Request.ROS_TYPE
        assert f"{package}/srv/{name}_Response" == service.Response.ROS_TYPE


def test_generated_files_are_up_to_date() -> None:
    script = ROOT / "scripts/generate_messages.py"
    done = subprocess.run([sys.executable, str(script), "--check"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_parser_reads_bounds_defaults_constants_and_comments() -> None:
    text = """
# Opens the file
# with two lines.
uint8 A=1   # a comment
string NAME='a # in quotes'
byte FLAG = 0x10

string<=256 name "me"  # trailing
string<=5[<=3] names
float64[9] k
Point32[] points
std_msgs/Header header
float32 ratio 0.5
bool on true
int8[] steps [-1, 0, 1]
"""
    (structure,) = parse(text, "demo_msgs")
    assert structure.comment == "Opens the file with two lines."
    assert [(c.name, c.value) for c in structure.constants] == [
        ("A", 1),
        ("NAME", "a # in quotes"),
        ("FLAG", b"\x10"),
    ]
    assert [tuple(field) for field in structure.fields] == [
        ("name", BoundedString(256), "me"),
        ("names", BoundedSequence(BoundedString(5), 3), None),
        ("k", Array(BasicType("double"), 9), None),
        ("points", UnboundedSequence(NamespacedType(("demo_msgs", "msg"), "Point32")), None),
        ("header", NamespacedType(("std_msgs", "msg"), "Header"), None),
        ("ratio", BasicType("float"), 0.5),
        ("on", BasicType("boolean"), True),
        ("steps", UnboundedSequence(BasicType("int8")), [-1, 0, 1]),
    ]


def test_parser_splits_services_and_actions() -> None:
    request, response = parse("---\nbool success\n", "demo_msgs", 2)
    assert (request.fields, [field.name for field in response.fields]) == ([], ["success"])
    assert len(parse("int8 a\n---\n---\nint8 b", "demo_msgs", 3)) == 3


@pytest.mark.parametrize(
    ("text", "expected"), [("int8", "not a field"), ("int8<=3 a", "bound"), ("---\n", "expected 1")]
)
def test_parser_refuses_invalid_definitions(text: str, expected: str) -> None:
    with pytest.raises(ValueError, match=expected):
        parse(text, "demo_msgs")
