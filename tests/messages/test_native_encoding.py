# SPDX-License-Identifier: Apache-2.0
"""The native encoder writes the bytes that the Python code writes, and leaves to it what it does not handle."""

import random
from array import array
from collections import UserList
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from coframe.messages import codec, deserialize, find, serialize
from coframe.messages.native_encoding import native_encoder
from geometry_msgs.msg import Point, TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState, LaserScan, PointCloud2
from std_msgs.msg import ByteMultiArray, Float32, Header, String, UInt64
from tf2_msgs.msg import TFMessage


def in_python(message: Any) -> bytes:
    return codec._serialize_in_python(message, type(message))


def with_value(message: Any, slot: str, value: Any) -> Any:
    """Return the message with a value that its setters would not accept in this form."""
    setattr(message, slot, value)
    return message


def test_both_encoders_write_the_same_bytes(ros_type: str, random_message: Callable[..., Any]) -> None:
    cls = find(ros_type)
    rng = random.Random(ros_type)
    encoder = native_encoder(cls)
    for _ in range(3):
        message = random_message(cls, rng)
        data = in_python(message)
        assert encoder is None or encoder.encode(message) == data
        assert serialize(message) == data


def test_the_usual_messages_are_serialized_natively() -> None:
    for cls in (TFMessage, JointState, PointCloud2, LaserScan, Odometry):
        encoder = native_encoder(cls)
        assert encoder is not None
        assert encoder.encode(cls()) == in_python(cls())
    assert native_encoder(ByteMultiArray) is None  # It has a field of the type byte.


@pytest.mark.parametrize("size", [0, 1, 3, 4095, 4096, 100_001])
def test_large_arrays_keep_what_is_around_them(size: int) -> None:
    scan = LaserScan(ranges=[0.5] * size, intensities=[1.5] * (size // 2 + 1))
    cloud = PointCloud2(header=Header(frame_id="lidar"), data=array("B", bytes(size)), is_dense=True)
    joints = JointState(name=["odd"], position=[0.25] * size, velocity=[0.5] * size)
    for message in (scan, cloud, joints):
        encoder = native_encoder(type(message))
        assert encoder is not None
        data = encoder.encode(message)
        assert data == in_python(message)
        assert deserialize(data, type(message)) == message


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
    encoder = native_encoder(type(message))
    assert encoder is not None
    assert encoder.encode(message) is None
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


def test_a_deleted_field_is_named() -> None:
    message = Point()
    del message._y
    with pytest.raises(TypeError, match="cannot serialize geometry_msgs/msg/Point, field x to z"):
        serialize(message)
