# SPDX-License-Identifier: Apache-2.0
"""Convert the arguments of tf2's functions for the core: nanoseconds, checked names and pose values."""

import warnings
from operator import index
from typing import Any

from coframe.time import SECOND
from geometry_msgs.msg import Quaternion, Vector3
from rclpy.time import Time


def nanoseconds(value: Any, what: str) -> int:
    """Return the nanoseconds of a time or duration, which is a message or an object of rclpy."""
    if type(value) is Time:  # The common case. Catching an AttributeError would cost more than a lookup.
        return value.nanoseconds
    try:
        return index(value.sec) * SECOND + index(value.nanosec)
    except AttributeError:
        pass
    try:
        return index(value.nanoseconds)
    except AttributeError:
        kind = "Duration" if what == "duration" else "Time"
        latest = "" if kind == "Duration" else ", or Time() for the latest transform"
        raise TypeError(
            f"{what} must have sec and nanosec, or nanoseconds. "
            f"Got {type(value).__name__}. Use rclpy's {kind}(seconds=...){latest}."
        ) from None


def text(value: Any, position: int) -> str:
    """Return a string argument, or raise the errors of Python's C interface for values that are not C strings."""
    if not isinstance(value, str):
        raise TypeError(f"argument {position} must be str, not {type(value).__name__}")
    if "\0" in value:
        raise ValueError("embedded null character")
    return value


def frame_id(value: Any, field: str) -> str:
    """Return the frame name of a message field, or raise an error if it is not a string."""
    if not isinstance(value, str):
        raise TypeError(f"{field} must be str, not {type(value).__name__}")
    if "\0" in value:
        raise ValueError(f"{field} has an embedded null character")
    return value


def values(transform: Any, *, static: bool) -> tuple[Any, Any, Any, Any, Any, Any, Any]:
    """Return x, y, z, qx, qy, qz, qw of a `geometry_msgs/Transform`. The core checks that they are numbers."""
    translation, rotation = transform.translation, transform.rotation
    if not isinstance(translation, Vector3):
        warnings.warn("translation should be of type Vector3", UserWarning, stacklevel=4)
        raise TypeError(
            "transform.translation must be of type Vector3"
            if static
            else "transform.translation must have members x, y, z"
        )
    if not isinstance(rotation, Quaternion):
        warnings.warn("translation should be of type Quaternion", UserWarning, stacklevel=4)
    return (
        translation.x,
        translation.y,
        translation.z,
        rotation.x,
        rotation.y,
        rotation.z,
        rotation.w,
    )


def full_query(
    target_frame: Any, target_time: Any, source_frame: Any, source_time: Any, fixed_frame: Any
) -> tuple[str, int, str, int, str]:
    """Return the five arguments of a lookup between two times, converted for the core."""
    return (
        text(target_frame, 1),
        nanoseconds(target_time, "time"),
        text(source_frame, 3),
        nanoseconds(source_time, "time"),
        text(fixed_frame, 5),
    )
