# SPDX-License-Identifier: Apache-2.0
"""Conversion of the core's results to messages and times.

The values are written directly into the slots, because they need no checks. This also allows stamps beyond the 32-bit
seconds of a message, and stamps before the epoch, which the constructor of rclpy's `Time` rejects.
"""

# ruff: noqa: SLF001

from typing import Any

from builtin_interfaces.msg import Time as TimeMessage
from coframe import _core
from coframe.time import SECOND
from coframe.workspace.ros_side import tf2_is_replaced
from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from rclpy.time import Time
from std_msgs.msg import Header

Pose = tuple[float, float, float, float, float, float, float]


def transform_stamped(target: str, source: str, stamp: int, pose: Pose) -> TransformStamped:
    """Return the `TransformStamped` that transforms data from `source` into `target`."""
    result = TransformStamped()
    slots: Any = result
    header, transform = slots._header, slots._transform
    time, translation, rotation = header._stamp, transform._translation, transform._rotation
    time._sec, time._nanosec = divmod(stamp, SECOND)
    header._frame_id = target
    slots._child_frame_id = source
    translation._x, translation._y, translation._z, rotation._x, rotation._y, rotation._z, rotation._w = pose
    return result


def any_time(nanoseconds: int) -> Time:
    """Return the `Time` of a stamp, which may be negative with coframe's rclpy."""
    if tf2_is_replaced():
        return Time(nanoseconds=nanoseconds)
    result = Time()
    result._nanoseconds = nanoseconds
    return result


if not tf2_is_replaced():  # The core contains the layout of coframe's classes only.
    _core.register_messages(TransformStamped, Header, TimeMessage, Time, Transform, Vector3, Quaternion)
