"""The core's answers as messages and times.

The numbers go straight into the slots: they need no checking. A stamp that is too late for a message's 32-bit seconds
is still an answer, and so is one before the epoch, which the constructor of rclpy's `Time` refuses.
"""

# ruff: noqa: SLF001

from typing import Any

from builtin_interfaces.msg import Time as TimeMessage
from coframe import _core
from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from rclpy.time import Time
from std_msgs.msg import Header
from tf2_py._convert import NANOSECONDS_PER_SECOND

Pose = tuple[float, float, float, float, float, float, float]


def transform_stamped(target: str, source: str, stamp: int, pose: Pose) -> TransformStamped:
    """The `TransformStamped` that takes data from `source` to `target`."""
    result = TransformStamped()
    slots: Any = result
    header, transform = slots._header, slots._transform
    time, translation, rotation = header._stamp, transform._translation, transform._rotation
    time._sec, time._nanosec = divmod(stamp, NANOSECONDS_PER_SECOND)
    header._frame_id = target
    slots._child_frame_id = source
    translation._x, translation._y, translation._z, rotation._x, rotation._y, rotation._z, rotation._w = pose
    return result


def any_time(nanoseconds: int) -> Time:
    """The `Time` of a stamp, also of a negative one."""
    result = Time()
    result._nanoseconds = nanoseconds
    return result


_core.register_messages(TransformStamped, Header, TimeMessage, Time, Transform, Vector3, Quaternion)
