"""Between what tf2's callers hand over and what the core takes: nanoseconds, checked names, seven numbers."""

import warnings
from operator import index
from typing import Any

from geometry_msgs.msg import Quaternion, Vector3
from rclpy.time import Time

NANOSECONDS_PER_SECOND = 1_000_000_000


def nanoseconds(value: Any, what: str) -> int:
    """The nanoseconds of a time or duration: of a message (`sec`, `nanosec`) or of rclpy's (`nanoseconds`)."""
    if type(value) is Time:  # most are, and a missing attribute costs more than a look-up
        return value.nanoseconds
    try:
        return index(value.sec) * NANOSECONDS_PER_SECOND + index(value.nanosec)
    except AttributeError:
        pass
    try:
        return index(value.nanoseconds)
    except AttributeError:
        kind = "Duration" if what == "duration" else "Time"
        advice = f"{type(value).__name__} does not: give rclpy's {kind}(seconds=...)"
        latest = "" if kind == "Duration" else ", or Time() for the latest"
        raise TypeError(f"{what} must have sec and nanosec, or nanoseconds. {advice}{latest}.") from None


def text(value: Any, position: int) -> str:
    """A string argument; refuses what C strings cannot carry, in the words of Python's own C interface."""
    if not isinstance(value, str):
        raise TypeError(f"argument {position} must be str, not {type(value).__name__}")
    if "\0" in value:
        raise ValueError("embedded null character")
    return value


def frame_id(value: Any, field: str) -> str:
    """A frame name out of a message; anything but a string is the caller's mistake, not bad data."""
    if not isinstance(value, str):
        raise TypeError(f"{field} must be str, not {type(value).__name__}")
    if "\0" in value:
        raise ValueError(f"{field} has an embedded null character")
    return value


def values(transform: Any, *, static: bool) -> tuple[Any, Any, Any, Any, Any, Any, Any]:
    """x, y, z, qx, qy, qz, qw of a `geometry_msgs/Transform`, as they are: the core checks that they are numbers."""
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
    """The five arguments of a look-up between two times, as the core takes them."""
    return (
        text(target_frame, 1),
        nanoseconds(target_time, "time"),
        text(source_frame, 3),
        nanoseconds(source_time, "time"),
        text(fixed_frame, 5),
    )
