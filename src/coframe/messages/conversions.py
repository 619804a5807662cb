"""Between coframe's values and the messages of the wire."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.messages.generated.builtin_interfaces.msg import Time
from coframe.messages.generated.geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from coframe.messages.generated.geometry_msgs.msg import Transform as TransformMessage
from coframe.messages.generated.std_msgs.msg import Header

if TYPE_CHECKING:
    from coframe.transform import Transform

__all__ = ["to_time", "to_transform_stamped"]

_NANOSECONDS_PER_SECOND = 1_000_000_000


def to_time(stamp: int) -> Time:
    """Nanoseconds since the epoch as a message."""
    seconds, nanoseconds = divmod(stamp, _NANOSECONDS_PER_SECOND)
    return Time(sec=seconds, nanosec=nanoseconds)


def to_transform_stamped(parent: str, child: str, transform: Transform, stamp: int) -> TransformStamped:
    """Where ``child`` is, seen from ``parent``, at ``stamp`` nanoseconds, as a message."""
    x, y, z, qx, qy, qz, qw = transform.values
    return TransformStamped(
        header=Header(stamp=to_time(stamp), frame_id=parent),
        child_frame_id=child,
        transform=TransformMessage(translation=Vector3(x=x, y=y, z=z), rotation=Quaternion(x=qx, y=qy, z=qz, w=qw)),
    )
