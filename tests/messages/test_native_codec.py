# SPDX-License-Identifier: Apache-2.0
"""The native codec does what the Python code does, and leaves to it what it does not handle."""

import random
from array import array
from collections import UserList
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from coframe.errors import DecodeError
from coframe.messages import Message, codec, deserialize, find, serialize
from coframe.messages.message import complete_repr
from coframe.messages.native_codec import native_codec
from geometry_msgs.msg import Point, TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState, LaserScan, PointCloud2
from std_msgs.msg import ByteMultiArray, Float32, Header, String, UInt64
from tf2_msgs.msg import TFMessage


def text(message: Message | None) -> str:
    return "refused" if message is None else complete_repr(message)


def in_python(message: Any) -> bytes:
    return codec._serialize_in_python(message, type(message))


def read_in_python(data: bytes, cls: Any) -> Any:
    """Return the message, or None if the Python code refuses the bytes."""
    try:
        return codec._deserialize_in_python(data, cls)
    except DecodeError:
        return None


def with_value(message: Any, slot: str, value: Any) -> Any:
    """Return the message with a value that its setters would not accept in this form."""
    setattr(message, slot, value)
    return message


def test_both_codecs_agree(ros_type: str, random_message: Callable[..., Any]) -> None:
    cls = find(ros_type)
    rng = random.Random(ros_type)
    native = native_codec(cls)
    for _ in range(3):
        message = random_message(cls, rng)
        data = in_python(message)
        assert serialize(message) == data
        assert deserialize(data, cls) == message
        if native is None:
            continue
        assert native.encode(message) == data
        assert text(native.decode(data)) == text(read_in_python(data, cls))


def test_both_codecs_agree_on_damaged_bytes(random_message: Callable[..., Any]) -> None:
    rng = random.Random(1)
    refused = 0
    classes = [TFMessage, JointState, PointCloud2, LaserScan, Odometry, find("visualization_msgs/msg/MarkerArray")]
    for _ in range(3_000):
        cls = rng.choice(classes)
        data = bytearray(serialize(random_message(cls, rng)))
        for _ in range(rng.randint(0, 3)):
            data[rng.randrange(len(data))] = rng.choice([0, 1, 0x7F, 0x80, 0xFF])
        if rng.random() < 0.3:
            del data[rng.randrange(len(data)) :]
        expected = read_in_python(bytes(data), cls)
        native = native_codec(cls)
        assert native is not None
        decoded = native.decode(bytes(data))
        refused += decoded is None
        # Bytes in big endian, which a changed header can say, are left to the Python code.
        assert text(decoded) == text(expected) or (decoded is None and data[1] != 1)
    assert 500 < refused < 2_500


def test_the_usual_messages_are_serialized_natively() -> None:
    for cls in (TFMessage, JointState, PointCloud2, LaserScan, Odometry):
        native = native_codec(cls)
        assert native is not None
        assert native.encode(cls()) == in_python(cls())
    assert native_codec(ByteMultiArray) is None  # It has a field of the type byte.


@pytest.mark.parametrize("size", [0, 1, 3, 4095, 4096, 100_001])
def test_large_arrays_keep_what_is_around_them(size: int) -> None:
    scan = LaserScan(ranges=[0.5] * size, intensities=[1.5] * (size // 2 + 1))
    cloud = PointCloud2(header=Header(frame_id="lidar"), data=array("B", bytes(size)), is_dense=True)
    joints = JointState(name=["odd"], position=[0.25] * size, velocity=[0.5] * size)
    for message in (scan, cloud, joints):
        native = native_codec(type(message))
        assert native is not None
        data = native.encode(message)
        assert data == in_python(message)
        assert native.decode(data) == message
        assert native.decode(bytearray(data)) == message


class Text(str):
    __slots__ = ()


class Stamped(TransformStamped):
    pass


@pytest.mark.parametrize(
    "message",
    [
        with_value(Point(), "_x", 5),
        with_value(Point(), "_x", np.float64(5.0)),
        with_value(String(), "_data", Text("hello")),
        with_value(Float32(), "_data", float("nan")),
        with_value(UInt64(), "_data", np.uint64(2**64 - 1)),
        with_value(LaserScan(), "_ranges", array("d", [1.0, 2.0])),
        with_value(Odometry().pose, "_covariance", np.arange(72.0)[::2]),
        with_value(Odometry().pose, "_covariance", np.arange(36.0).astype(">f8")),
        with_value(TFMessage(), "_transforms", UserList([TransformStamped()])),
        TFMessage(transforms=[Stamped()]),
    ],
)
def test_values_in_an_unusual_form_are_left_to_python(message: Any) -> None:
    native = native_codec(type(message))
    assert native is not None
    assert native.encode(message) is None
    assert serialize(message) == in_python(message)


@pytest.mark.parametrize(
    ("message", "text"),
    [
        (with_value(String(), "_data", "a\0b"), "a NUL character"),
        (with_value(String(), "_data", "\ud800"), "surrogates not allowed"),
        (with_value(UInt64(), "_data", 2**64), "cannot serialize std_msgs/msg/UInt64, field data"),
        (with_value(UInt64(), "_data", -1), "cannot serialize std_msgs/msg/UInt64, field data"),
        (with_value(Float32(), "_data", 1e39), "cannot serialize std_msgs/msg/Float32, field data"),
        (with_value(Odometry().pose, "_covariance", np.zeros(35)), "not 36 numbers"),
        (with_value(TFMessage(), "_transforms", [None]), "cannot serialize tf2_msgs/msg/TFMessage"),
    ],
)
def test_values_that_no_encoder_accepts(message: Any, text: str) -> None:
    with pytest.raises((ValueError, TypeError), match=text):
        serialize(message)


def test_decoded_arrays_belong_to_the_message() -> None:
    native = native_codec(Odometry)
    assert native is not None
    data = bytearray(serialize(Odometry()))
    odometry = native.decode(data)
    data[-8:] = b"\xff" * 8
    assert odometry == Odometry()
    assert odometry.pose.covariance.flags.owndata
    assert odometry.pose.covariance.flags.writeable
    assert odometry.pose.covariance.dtype == np.float64


def test_a_deleted_field_is_named() -> None:
    message = Point()
    del message._y
    with pytest.raises(TypeError, match="cannot serialize geometry_msgs/msg/Point, field x to z"):
        serialize(message)


@pytest.mark.parametrize("cls", [String, Point, PointCloud2, ByteMultiArray])
def test_whole_messages_have_at_most_their_padding_after_them(cls: Any) -> None:
    data = serialize(cls())
    assert codec.deserialize_whole(data + b"\x01\x02\x03", cls) == cls()
    with pytest.raises(DecodeError, match=f"the message ends at byte {len(data)} of {len(data) + 4}"):
        codec.deserialize_whole(data + bytes(4), cls)
    assert deserialize(data + bytes(4), cls) == cls()


def test_whole_messages_in_big_endian() -> None:
    data = b"\x00\x00\x00\x00" + (5).to_bytes(8, "big")
    assert codec.deserialize_whole(data, UInt64).data == 5
    with pytest.raises(DecodeError, match="the message ends at byte 12 of 16"):
        codec.deserialize_whole(data + bytes(4), UInt64)
