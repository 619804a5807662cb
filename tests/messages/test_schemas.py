# SPDX-License-Identifier: Apache-2.0
"""Definitions in recordings: the ways in which programs write them, and the limits of what they can ask for."""

import time

import pytest

from coframe.errors import InterfaceError
from coframe.messages import deserialize, find, serialize, to_yaml
from coframe.messages.codec import deserialize_ros1
from coframe.messages.limits import MAX_CONSTANTS, MAX_DEFINITION, MAX_DEPTH, MAX_NESTING, MAX_TYPES
from coframe.messages.message import Message
from coframe.messages.schema_classes import ResolvedSchema, SchemaClasses
from coframe.messages.schemas import parse_schema, ros_name

TYPE = "lab_msgs/msg/Wheel"
LINE = "=" * 80 + "\n"
HEADER = "builtin_interfaces/Time stamp\nstring frame_id\n"
WHEEL = f"std_msgs/Header header\nfloat64 radius\nuint8[] dots\n{LINE}MSG: std_msgs/Header\n{HEADER}"
PLAIN_IDL = """module lab_msgs { module msg {
  struct Wheel { std_msgs::msg::Header header; double radius; sequence<uint8> dots; };
}; };
"""
DDS_IDL = """#include "Header.idl"
module lab_msgs { module msg { module dds_ {
  struct Wheel_ { std_msgs::msg::dds_::Header_ header_; double radius_; sequence<octet> dots_; };
}; }; };
"""


def class_of(text, name=TYPE, format_="ros2msg"):
    data = text if isinstance(text, bytes) else text.encode()
    schema = ResolvedSchema(parse_schema(data, name, format_))
    return SchemaClasses().of(schema, is_ros1=format_ == "ros1msg")


def refusal(text, format_="ros2msg"):
    started = time.process_time()
    with pytest.raises(InterfaceError) as caught:
        class_of(text, format_=format_)
    assert time.process_time() - started < 2
    return str(caught.value)


def described_wheel():
    return class_of(WHEEL)


@pytest.mark.parametrize(
    "text",
    [
        WHEEL,
        WHEEL.replace("\n", "\r\n"),
        "\n".join(f"\t  {line}" for line in WHEEL.splitlines()),
        WHEEL.replace("float64 radius", "float64\t\tradius   "),
        WHEEL.replace("=" * 80, "=" * 40),
        WHEEL.replace("=" * 80, "=" * 90 + "  "),
        WHEEL.replace("MSG: ", "MSG:"),
        WHEEL.replace("std_msgs/", "std_msgs/msg/"),
        WHEEL.replace("std_msgs/Header header", "Header header"),
        WHEEL.partition(LINE)[0],
        f"MSG: lab_msgs/Wheel\n{WHEEL}",
        f"\ufeff# Größe\n\n{WHEEL}".rstrip("\n"),
        ("# caf\xe9\n" + WHEEL).encode("latin-1"),
        WHEEL.replace("float64", "int32 max=7\nstring NAME='# 1'\nfloat64"),
    ],
    ids=range(14),
)
def test_texts_of_msg_files_in_all_forms(text):
    cls = class_of(text)
    assert cls.get_fields_and_field_types() == {
        "header": "std_msgs/Header",
        "radius": "double",
        "dots": "sequence<uint8>",
    }
    message = cls(radius=0.5, dots=b"ab")
    message.header.frame_id = "axle"
    assert deserialize(serialize(message), cls) == message
    assert type(message.header) is find("std_msgs/msg/Header")


@pytest.mark.parametrize("kind", ["bare", "titled", "crlf", "commented", "dds"])
def test_texts_of_idl_files_in_all_forms(kind):
    header = (
        "module std_msgs { module msg { struct Header { builtin_interfaces::msg::Time stamp; string frame_id; }; }; };"
    )
    titled = f"{LINE}IDL: {TYPE}\n// generated\n{PLAIN_IDL}\n{LINE}IDL: std_msgs/msg/Header\n{header}\n"
    text = {"bare": PLAIN_IDL, "titled": titled, "crlf": titled.replace("\n", "\r\n"), "dds": DDS_IDL}.get(kind)
    if kind == "commented":
        text = titled.replace("  struct", '  @verbatim (language="comment", text="a" "wheel")\n  struct')
    cls = class_of(text, format_="omgidl" if kind == "dds" else "ros2idl")
    assert list(cls.get_fields_and_field_types()) == ["header", "radius", "dots"]
    assert cls().header == find("std_msgs/msg/Header")()


def test_messages_of_a_definition_are_like_all_messages():
    message = described_wheel()(radius=2.0)
    assert isinstance(message, Message)
    assert "radius: 2.0" in to_yaml(message)
    assert "Wheel" in message._repr_html_()
    with pytest.raises(AssertionError, match="must be of type 'float'"):
        message.radius = "large"
    with pytest.raises(LookupError):
        find(TYPE)


def test_definitions_that_match_have_coframes_classes():
    imu = find("sensor_msgs/msg/Imu")
    named = "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n"
    more = "".join(
        f"geometry_msgs/Vector3 {name}\nfloat64[9] {name}_covariance\n"
        for name in ("angular_velocity", "linear_acceleration")
    )
    assert class_of(named + more, "sensor_msgs/msg/Imu") is imu
    other = class_of(named + more.replace("float64[9]", "float64[6]"), "sensor_msgs/msg/Imu")
    assert other is not imu
    assert (other.ROS_TYPE, len(other().angular_velocity_covariance)) == (imu.ROS_TYPE, 6)
    assert find("sensor_msgs/msg/Imu") is imu
    nested = class_of(f"{LINE}MSG: lab_msgs/Wheel\nHeader head\n{LINE}MSG: std_msgs/Header\nint32 number\n")
    assert nested().head.get_fields_and_field_types() == {"number": "int32"}


def test_equal_definitions_of_a_recording_have_one_class():
    classes = SchemaClasses()
    first, second = (
        classes.of(ResolvedSchema(parse_schema(f"# {i}\nint32 x\n".encode(), TYPE, "ros2msg")), is_ros1=False)
        for i in range(2)
    )
    assert first is second


def test_texts_of_ros_1():
    text = "int32 low=3\nHeader header\ntime at\nduration took\nfloat64[9] K\nbyte level\n"
    cls = class_of(text, format_="ros1msg")
    data = b"\7\0\0\0" + b"\1\0\0\0\2\0\0\0" + b"\4\0\0\0axle" + b"\3\0\0\0\4\0\0\0" + b"\xff\xff\xff\xff\5\0\0\0"
    message = deserialize_ros1(data + bytes(72) + b"\x02", cls)
    assert (message.header.frame_id, message.header.stamp.sec, message.at.nanosec) == ("axle", 1, 4)
    assert (message.took.sec, len(message.K), message.level, cls.low) == (-1, 9, b"\2", 3)
    with pytest.raises(ValueError, match="found only 0 bytes"):
        deserialize_ros1(data, cls)


def test_events_of_services():
    event = "lab_msgs/srv/Turn_Event"
    text = f"{LINE}SRV: lab_msgs/srv/Turn\nfloat64 angle\n---\nbool done\n"
    cls = class_of(text, event)
    assert cls(request=[cls.SLOT_TYPES[1].value_type.message_class(angle=1.0)]).request[0].angle == 1.0
    written = (
        "service_msgs/ServiceEventInfo info\nlab_msgs/srv/Turn_Request[<=1] request\n"
        f"lab_msgs/srv/Turn_Response[<=1] response\n{LINE}MSG: lab_msgs/srv/Turn_Request\nfloat64 angle\n"
        f"{LINE}MSG: lab_msgs/srv/Turn_Response\nbool done\n"
    )
    assert class_of(written, event).get_fields_and_field_types() == cls.get_fields_and_field_types()


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("std_msgs/Header", "std_msgs/msg/Header"),
        ("std_msgs/msg/Header", "std_msgs/msg/Header"),
        ("std_msgs::msg::dds_::Header_", "std_msgs/msg/Header"),
        ("std_msgs::msg::Header", "std_msgs/msg/Header"),
        ("lab/srv/Turn_Event", "lab/srv/Turn_Event"),
        ("Wheel", "Wheel"),
    ],
)
def test_names_of_types(given, expected):
    assert ros_name(given) == expected


@pytest.mark.parametrize("name", ["", "*", "a/b/c/d", "a/msg/B\nimport os", "__class__", "a//B", "1/msg/B", "a/msg/ü"])
def test_names_that_are_not_those_of_types(name):
    with pytest.raises(ValueError, match="is not the name of a message type"):
        ros_name(name)


def idl(constant="const long A = 1;", fields="long x;"):
    parts = ("module lab_msgs { module msg {", "module Wheel_Constants {", constant, "};", "struct Wheel {", fields)
    return "\n".join([*parts, "}; }; };"])


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("1 << 4 | 3", 19),
        ("(2 + 3) * 4 - 7 / 2 % 2", 19),
        ("-(-5) ^ ~0 & 6", 3),
        ("0x1F", 31),
        ("010", 8),
        ("((((((((((((1))))))))))))", 1),
        ("-7 / 2", -3),
    ],
)
def test_expressions_of_idl(expression, value):
    assert value == class_of(idl(f"const long A = {expression};"), format_="ros2idl").A


def test_constants_as_sizes_in_idl():
    cls = class_of(
        idl("const long A = 2;", "double a[Wheel_Constants::A + 1]; sequence<string<4>, 2 * 3> b;"), format_="ros2idl"
    )
    assert cls.get_fields_and_field_types() == {"a": "double[3]", "b": "sequence<string<4>, 6>"}


MANY_CONSTANTS = "\n".join(f"const long A{i} = 1;" for i in range(MAX_CONSTANTS + 1))
HOSTILE_IDL = {
    "shift": (idl("const long A = 1 << 30000000000;"), "line 3: a value is shifted by 30000000000 bits"),
    "negative shift": (idl("const long A = 1 << -1;"), "line 3: a value is shifted by -1 bits"),
    "product": (
        idl("const long A = 4294967295 * 4294967296 * 4294967296;"),
        "line 3: a value has 96 bits; the maximum is 64",
    ),
    "sum": (idl("const long A = 18446744073709551615 + 18446744073709551615;"), "line 3: a value has 65 bits"),
    "division": (idl("const long A = 1 / 0;"), "line 3: a division by zero"),
    "power": (idl("const long A = 9 ** 99;"), "line 3: expected a value, found *"),
    "digits": (idl(f"const long A = {'9' * 5000};"), "line 3: a number has 5000 characters; the maximum is 400"),
    "parentheses": (
        idl(f"const long A = {'(' * 500}1{')' * 500};"),
        f"line 3: parentheses or signs are nested more than {MAX_NESTING} levels deep",
    ),
    "signs": (
        idl(f"const long A = {'-' * 500}1;"),
        f"line 3: parentheses or signs are nested more than {MAX_NESTING} levels deep",
    ),
    "modules": ("module a {" * 500, f"line 1: modules are nested more than {MAX_NESTING} levels deep"),
    "sequences": (idl(fields="sequence<" * 300 + "long" + ">" * 300 + " x;"), "line 6: ROS does not support sequences"),
    "constants": (
        idl(MANY_CONSTANTS),
        f"line {MAX_CONSTANTS + 3}: the definition has more than {MAX_CONSTANTS} constants",
    ),
    "structures": (
        "\n".join(f"struct A{i} {{ long x; }};" for i in range(MAX_TYPES + 1)),
        f"line {MAX_TYPES + 1}: the definition has more than {MAX_TYPES} structures",
    ),
    "text": (idl(f'const string A = "{"a" * 30_000}";'), "line 3: a string has 30002 characters"),
    "text times number": (idl('const long A = "a" * 1000;'), "line 3: the operator * cannot be applied to 'a'"),
    "string length": (idl(fields="string<99999999999999> x;"), "line 6: a size must be from 1 to 4294967295"),
    "array": (idl(fields="long x[9999999999];"), "line 6: a size must be from 1 to 4294967295"),
    "memory": (idl(fields="string x[4000000000];"), "line 6: a message with default values would need"),
    "annotations": ("@a(" * 500 + "1" + ")" * 500, "line 1: expected a value"),
    "comment": ("/*" + "*" * 200_000, "line 1: expected a name"),
}


@pytest.mark.parametrize("kind", HOSTILE_IDL)
def test_hostile_idl_is_refused_at_once_with_its_line(kind):
    text, expected = HOSTILE_IDL[kind]
    assert refusal(text, "ros2idl").startswith(expected)


CHAIN = "lab/L0 x\n" + "".join(f"{LINE}MSG: lab/L{i}\nlab/L{i + 1} x\n" for i in range(MAX_DEPTH + 1))
HOSTILE_MSG = {
    "types": (
        "int32 x\n" + "".join(f"MSG: a{i}/B\nint32 x\n" for i in range(MAX_TYPES + 1)),
        f"line {2 * MAX_TYPES + 2}: the definition has more than {MAX_TYPES} messages",
    ),
    "constants": (
        "\n".join(f"int32 A{i}=1" for i in range(MAX_CONSTANTS + 1)),
        f"line {MAX_CONSTANTS + 1}: the definition has more than",
    ),
    "fields": (
        "".join(f"int32 a{i}\n" for i in range(20_001)),
        "line 20001: the definition has more than 20000 fields",
    ),
    "digits": (f"int32 x\nint32 A={'9' * 5000}", "line 2: a number has 5000 characters; the maximum is 400"),
    "line": (f"int32 x\nstring A='{'a' * 30_000}'", "line 2: a line has 30011 characters"),
    "string length": ("string<=99999999999999 x", "line 1: a size must be from 1 to 4294967295"),
    "array": ("int32[99999999999] x", "line 1: a size must be from 1 to 4294967295"),
    "memory": ("int32 y\nstring[1000000000] x", "line 2: a message with default values would need"),
    "depth": (
        f"{CHAIN}{LINE}MSG: lab/L{MAX_DEPTH + 1}\nint32 x\n",
        f"line {3 * MAX_DEPTH + 1}: messages are nested more than {MAX_DEPTH} levels deep",
    ),
    "cycle": (f"lab/A x\n{LINE}MSG: lab/A\nint32 y\nlab/A[] x\n", "line 5: a message cannot contain itself"),
    "doubling": (
        "lab/L0 a\nlab/L0 b\n"
        + "".join(f"MSG: lab/L{i}\nlab/L{i + 1} a\nlab/L{i + 1} b\n" for i in range(40))
        + "MSG: lab/L40\nint32 x\n",
        "line 1: a message with default values would need",
    ),
    "loops": (
        "lab/L0[] a\n" + "".join(f"MSG: lab/L{i}\nlab/L{i + 1}[] a\n" for i in range(30)) + "MSG: lab/L30\nint32 x\n",
        "line 1: sequences are nested more than 16 levels deep",
    ),
    "missing": (
        f"lab/A x\n{LINE}MSG: lab/A\nint32 y\nlab/Gone x\n",
        "line 5: field 'x' of lab/msg/A: the recording does",
    ),
    "title": (f"int32 x\n{LINE}MSG: __class__\nint32 x\n", "line 3: '__class__' is not the name of a message type"),
    "reserved": ("int32 Message__values", "line 1: the name 'Message__values' is reserved"),
    "bytes": ("#" * MAX_DEFINITION + "\n", f"the definition has {MAX_DEFINITION + 1} bytes"),
}


@pytest.mark.parametrize("format_", ["ros1msg", "ros2msg"])
@pytest.mark.parametrize("kind", HOSTILE_MSG)
def test_hostile_msg_is_refused_at_once_with_its_line(kind, format_):
    text, expected = HOSTILE_MSG[kind]
    assert refusal(text, format_).startswith(expected)


def test_names_that_python_uses_are_only_names():
    names = ("None", "self", "cls", "exec", "fields", "array", "np", "set_fields", "class", "mro", "data")
    cls = class_of("".join(f"int32 {name}\n" for name in names))
    data = b"\0\1\0\0" + b"".join(bytes([i, 0, 0, 0]) for i in range(len(names)))
    message = deserialize(data, cls)
    assert [getattr(message, name) for name in names] == list(range(len(names)))
    assert serialize(message) == data
