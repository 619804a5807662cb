# SPDX-License-Identifier: Apache-2.0
"""Serialized bytes equal those of ROS 2, and invalid bytes are refused with a clear message."""

import random
import struct
import time
from array import array
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

from builtin_interfaces.msg import Time
from coframe.errors import DecodeError
from coframe.messages import Message, deserialize, find, serialize
from coframe.messages.definition import (
    AbstractType,
    Array,
    BasicType,
    BoundedString,
    BoundedWString,
    NamespacedType,
    UnboundedSequence,
    UnboundedString,
    UnboundedWString,
)
from coframe.messages.message import complete_repr
from geometry_msgs.msg import (
    Point,
    Pose,
    PoseStamped,
    Quaternion,
    Transform,
    TransformStamped,
    Vector3,
)
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import ParameterDescriptor, ParameterValue
from sensor_msgs.msg import CameraInfo, LaserScan, PointCloud2, PointField
from std_msgs.msg import Byte, ByteMultiArray, Empty, Header, String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

Builder = Callable[[Any, random.Random], Any]

SAMPLES: dict[str, Message] = {
    "empty": TFMessage(),
    "default_transformstamped": TFMessage(transforms=[TransformStamped()]),
    "one_map_odom": TFMessage(
        transforms=[
            TransformStamped(
                header=Header(stamp=Time(sec=1700000000, nanosec=123456789), frame_id="map"),
                child_frame_id="odom",
                transform=Transform(translation=Vector3(x=1.0, y=2.0, z=3.0)),
            )
        ]
    ),
    "two_odom_base_laser": TFMessage(
        transforms=[
            TransformStamped(
                header=Header(stamp=Time(sec=1700000000, nanosec=5), frame_id="odom"),
                child_frame_id="base_link",
                transform=Transform(
                    translation=Vector3(x=1.0, y=2.0, z=3.0),
                    rotation=Quaternion(z=0.7071067811865476, w=0.7071067811865476),
                ),
            ),
            TransformStamped(
                header=Header(frame_id="base_link"),
                child_frame_id="laser",
                transform=Transform(translation=Vector3(x=0.1, z=0.2)),
            ),
        ]
    ),
    "utf8_and_negative": TFMessage(
        transforms=[
            TransformStamped(
                header=Header(stamp=Time(sec=-1, nanosec=999999999), frame_id="wörld"),
                child_frame_id="kämera",
                transform=Transform(
                    translation=Vector3(x=-1e-9, y=1e9, z=float("nan")),
                    rotation=Quaternion(x=0.5, y=-0.5, z=0.5, w=-0.5),
                ),
            )
        ]
    ),
    "String": String(data="hello"),
    "PoseStamped": PoseStamped(header=Header(frame_id="map"), pose=Pose(position=Point(y=2.0))),
    "LaserScan": LaserScan(
        header=Header(stamp=Time(sec=7), frame_id="laser"),
        angle_min=-1.0,
        angle_max=1.0,
        angle_increment=0.5,
        range_max=10.0,
        ranges=[1.0, 2.0, 3.0, 4.0, 5.0],
    ),
    "PointCloud2": PointCloud2(
        header=Header(frame_id="lidar"),
        height=1,
        width=2,
        fields=[
            PointField(name=name, offset=offset, datatype=PointField.FLOAT32, count=1)
            for name, offset in (("x", 0), ("y", 4), ("z", 8))
        ],
        point_step=12,
        row_step=24,
        data=array("B", struct.pack("<6f", 1.0, 2.0, 3.0, 4.0, 5.0, 6.0)),
        is_dense=True,
    ),
}


def odometry_sample() -> Odometry:
    message = Odometry(header=Header(frame_id="odom"), child_frame_id="base_link")
    message.pose.pose.position.x = 1.5
    return message


SAMPLES["Odometry"] = odometry_sample()


@pytest.mark.parametrize("name", SAMPLES)
def test_messages_of_a_real_ros_stack_round_trip(name: str, shared: Path) -> None:
    data = bytes.fromhex((shared / f"wire_samples/humble_{name}.hex").read_text())
    message = SAMPLES[name]
    assert serialize(message).hex() == data.hex()
    decoded = deserialize(data, type(message))
    assert serialize(decoded) == data
    assert complete_repr(decoded) == complete_repr(message)


def test_every_recorded_sample_is_compared(shared: Path) -> None:
    files = {path.stem.removeprefix("humble_") for path in (shared / "wire_samples").glob("humble_*.hex")}
    assert files == set(SAMPLES)


def test_bytes_equal_those_of_rosbags(
    ros_type: str, store: Any, to_rosbags: Callable[[Any], Any], random_message: Builder
) -> None:
    rng = random.Random(ros_type)
    cls = find(ros_type)
    for _ in range(10):
        message = random_message(cls, rng)
        data = serialize(message)
        assert data == bytes(store.serialize_cdr(to_rosbags(message), ros_type))
        assert deserialize(data, cls) == message
        big = bytes(store.serialize_cdr(to_rosbags(message), ros_type, little_endian=False))
        assert deserialize(big, cls) == message
        theirs = store.deserialize_cdr(data, ros_type)
        assert bytes(store.serialize_cdr(theirs, ros_type)) == data


def test_messages_of_services_and_actions_round_trip(random_message: Builder) -> None:
    for ros_type in ("tf2_msgs/action/LookupTransform_SendGoal_Request", "std_srvs/srv/SetBool_Response"):
        message = random_message(find(ros_type), random.Random(1))
        assert deserialize(serialize(message), type(message)) == message


def test_a_message_without_fields_takes_one_byte() -> None:
    assert serialize(Empty()) == b"\0\1\0\0\0"
    assert deserialize(b"\0\1\0\0\0", Empty) == Empty()
    assert serialize(find("std_srvs/srv/Trigger").Request()) == b"\0\1\0\0\0"


def test_sequences_of_bytes_and_booleans() -> None:
    assert serialize(Byte(data=b"\xfe")) == b"\0\1\0\0\xfe"
    message = deserialize(serialize(ByteMultiArray(data=[b"\1", b"\xff"])), ByteMultiArray)
    assert message.data == [b"\1", b"\xff"]
    value = deserialize(serialize(ParameterValue(bool_array_value=[True, False])), ParameterValue)
    assert value.bool_array_value == [True, False]


def test_decoded_numbers_have_the_types_of_a_new_message() -> None:
    scan = deserialize(serialize(LaserScan(ranges=[1.0])), LaserScan)
    assert isinstance(scan.ranges, array)
    assert scan.ranges.typecode == "f"
    info = deserialize(serialize(CameraInfo()), CameraInfo)
    assert info.k.dtype == np.float64
    assert info.k.flags.writeable
    assert info.k.flags.owndata


def test_bytearray_memoryview_and_trailing_bytes_are_accepted() -> None:
    data = serialize(String(data="hi"))
    assert deserialize(bytearray(data), String).data == "hi"  # type: ignore[arg-type]
    assert deserialize(memoryview(data), String).data == "hi"  # type: ignore[arg-type]
    assert deserialize(data + b"\0\0", String).data == "hi"


def make(name: str, *types: AbstractType) -> Any:
    """Return a message class without a definition file, with fields a, b, c, ..."""
    slots = [f"_{letter}" for letter, _ in zip("abcdefgh", types, strict=False)]
    body: dict[str, Any] = {"ROS_TYPE": f"demo_msgs/msg/{name}", "__slots__": slots, "SLOT_TYPES": types}

    def init(self: Any, *values: Any) -> None:
        for slot, value in zip(slots, values, strict=True):
            setattr(self, slot[1:], value)

    return type(Message)(name, (Message,), {**body, "__init__": init})


class TestUnusedTypes:
    """Field types that no package uses."""

    SHIFTED: ClassVar[Any] = make(
        "Shifted",
        UnboundedString(),
        Array(BasicType("float"), 3),
        BasicType("uint8"),
        Array(BasicType("int16"), 2),
        UnboundedString(),
        Array(BasicType("double"), 2),
        Array(UnboundedString(), 2),
        Array(NamespacedType(("std_msgs", "msg"), "Empty"), 2),
    )

    @pytest.mark.parametrize("length", range(9))
    def test_padding_before_arrays(self, length: int) -> None:
        text = "x" * length
        message = self.SHIFTED(text, [1.0, 2.0, 3.0], 5, [-1, 2], text, [4.0, 5.0], [text, "y"], [Empty(), Empty()])
        expected = bytearray()

        def put(code: str, *values: Any) -> None:
            expected.extend(bytes(-len(expected) % struct.calcsize(code)))
            expected.extend(struct.pack(f"<{len(values)}{code}", *values))

        def put_text(value: str) -> None:
            put("I", len(value) + 1)
            expected.extend(value.encode() + b"\0")

        put_text(text)
        put("f", 1.0, 2.0, 3.0)
        put("B", 5)
        put("h", -1, 2)
        put_text(text)
        put("d", 4.0, 5.0)
        put_text(text)
        put_text("y")
        put("B", 0, 0)
        data = serialize(message)
        assert data == b"\0\1\0\0" + expected
        assert deserialize(data, self.SHIFTED) == message

    def test_an_empty_sequence_has_no_padding(self) -> None:
        cls = make("Gap", UnboundedSequence(BasicType("double")), BasicType("uint8"))
        assert serialize(cls([], 7)).hex() == "000100000000000007"
        assert deserialize(serialize(cls([], 7)), cls) == cls([], 7)
        assert serialize(cls([1.0], 7)).hex() == "000100000100000000000000000000000000f03f07"

    def test_wide_strings_are_utf16_in_four_bytes_per_unit(self) -> None:
        cls = make("Wide", UnboundedWString(), BasicType("uint8"))
        data = serialize(cls("é🤖", 9))
        assert data.hex() == "0001000003000000e90000003ed8000016dd000009"
        assert deserialize(data, cls) == cls("é🤖", 9)
        big = bytes.fromhex("0000000000000003000000e90000d83e0000dd1609")
        assert deserialize(big, cls) == cls("é🤖", 9)
        for wrong in ("0001000001000000ffff0100", "00010000010000003ed80000", "00010000ffffffff"):
            with pytest.raises(DecodeError):
                deserialize(bytes.fromhex(wrong), cls)

    def test_bounds_are_checked_when_serializing_and_deserializing(self) -> None:
        short, wide = make("Short", BoundedString(3)), make("ShortWide", BoundedWString(3))
        for cls in (short, wide):
            assert deserialize(serialize(cls("abc")), cls) == cls("abc")
            longer = make("Longer", UnboundedString() if cls is short else UnboundedWString())
            with pytest.raises(DecodeError, match="at most 3 characters"):
                deserialize(serialize(longer("abcd")), cls)
        descriptor = ParameterDescriptor()
        descriptor.integer_range.extend([find("rcl_interfaces/msg/IntegerRange")()] * 2)
        with pytest.raises(ValueError, match="field integer_range: more than 1 values"):
            serialize(descriptor)

    def test_subclasses_by_users_can_be_serialized(self) -> None:
        class Named(String):
            def upper(self) -> str:
                return self.data.upper()

        assert deserialize(serialize(Named(data="a")), Named).upper() == "A"


TF = serialize(SAMPLES["one_map_odom"])


@pytest.mark.parametrize(
    ("data", "cls", "text"),
    [
        (b"", String, "expected the CDR header"),
        (b"\0\1\0", String, "expected the CDR header"),
        (b"\0\7\0\0" + bytes(8), String, "found 00 07 00 00"),
        (b"\0\1\0\0", String, "String: at byte 4 of 4, for data: expected more than the 0 remaining bytes"),
        (b"\0\1\0\0\5\0\0\0abc\0", String, "expected 5 bytes, found only 4 bytes"),
        (b"\0\1\0\0\xff\xff\xff\xffabc\0", String, "expected 4294967295 bytes, found only 4 bytes"),
        (b"\0\1\0\0\4\0\0\0abcd", String, "ends with NUL, found 0x64"),
        (b"\0\1\0\0\4\0\0\0a\0b\0", String, "NUL only at its end"),
        (b"\0\1\0\0\3\0\0\0\xff\xfe\0", String, "for data: expected UTF-8, found ff"),
        (b"\0\1\0\0", Empty, "expected more than the 0 remaining bytes"),
        (
            TF[:-1],
            TFMessage,
            (
                r"at byte 33 of 91, for transforms\[\].transform.translation.x to "
                r"transforms\[\].transform.rotation.w: expected more than the 58 remaining bytes"
            ),
        ),
        (TF[:70], TFMessage, "at byte 8 of 70, for transforms: expected 1 values of at least 72 bytes each"),
        (b"\0\1\0\0\xff\xff\xff\xff" + bytes(72), TFMessage, "4294967295 values of at least 72 bytes each"),
        (serialize(CameraInfo())[:60], CameraInfo, "for k: expected 9 values of at least 8 bytes each"),
        (serialize(LaserScan(ranges=[1.0] * 9))[:60], LaserScan, "for ranges: expected 9 values of at least 4"),
    ],
)
def test_invalid_bytes_are_refused_with_a_clear_message(data: bytes, cls: Any, text: str) -> None:
    with pytest.raises(DecodeError, match=text) as caught:
        deserialize(data, cls)
    assert caught.value.hint


def test_a_wrong_length_of_elements_without_fields_is_refused() -> None:
    cls = make("Empties", UnboundedSequence(NamespacedType(("std_msgs", "msg"), "Empty")))
    start = time.perf_counter()
    with pytest.raises(DecodeError, match="4294967295 bytes, found only 3 bytes"):
        deserialize(b"\0\1\0\0\xff\xff\xff\xff\0\0\0", cls)
    assert time.perf_counter() - start < 1.0
    assert len(deserialize(b"\0\1\0\0\3\0\0\0\0\0\0", cls).a) == 3


def test_a_string_of_length_zero_is_empty() -> None:
    assert deserialize(b"\0\1\0\0\0\0\0\0", String).data == ""


@pytest.mark.parametrize("message", [SAMPLES["two_odom_base_laser"], SAMPLES["PointCloud2"], SAMPLES["LaserScan"]])
def test_every_truncated_message_is_refused(message: Message) -> None:
    data = serialize(message)
    for length in range(len(data)):
        with pytest.raises(DecodeError):
            deserialize(data[:length], type(message))


def test_mutated_messages_decode_or_are_refused(random_message: Builder) -> None:
    rng = random.Random(20)
    types = [TFMessage, LaserScan, PointCloud2, MarkerArray, ParameterValue, CameraInfo, Odometry, ByteMultiArray]
    originals = [(cls, bytearray(serialize(random_message(cls, rng)))) for cls in types for _ in range(5)]
    refused = 0
    for _ in range(24_000):
        cls, original = rng.choice(originals)
        data = original.copy()
        for _ in range(rng.randint(1, 4)):
            data[rng.randrange(len(data))] = rng.choice([0, 1, 0x7F, 0x80, 0xFF, rng.randrange(256)])
        if rng.random() < 0.3:
            del data[rng.randrange(len(data)) :]
        try:
            message = deserialize(bytes(data), cls)
        except DecodeError:
            refused += 1
        else:
            serialize(message)
    assert 5_000 < refused < 23_000


@pytest.mark.parametrize(
    ("broken", "error", "text"),
    [
        (String(), ValueError, "cannot serialize std_msgs/msg/String, field data: the string contains a NUL character"),
        (Header(), TypeError, "cannot serialize std_msgs/msg/Header, field stamp.sec to frame_id: "),
        (Time(), ValueError, "cannot serialize builtin_interfaces/msg/Time, field sec to nanosec: "),
    ],
)
def test_values_that_cannot_be_serialized_are_refused_with_a_clear_message(broken: Any, error: type, text: str) -> None:
    if isinstance(broken, String):
        broken.data = "a\0b"
    elif isinstance(broken, Header):
        broken._stamp = None
    else:
        broken._sec = 2**40
    with pytest.raises(error, match=text):
        serialize(broken)


def test_other_objects_are_not_messages() -> None:
    with pytest.raises(TypeError, match=r"builtins.int is not a message class"):
        serialize(5)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=r"std_srvs.srv.SetBool is not a message class. .*SetBool.Request"):
        deserialize(b"\0\1\0\0\0", find("std_srvs/srv/SetBool"))
