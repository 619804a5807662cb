# SPDX-License-Identifier: Apache-2.0
"""Convert coframe's values to messages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.messages.generated.builtin_interfaces.msg import Time
from coframe.messages.generated.geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from coframe.messages.generated.geometry_msgs.msg import Transform as TransformMessage
from coframe.messages.generated.std_msgs.msg import Header
from coframe.time import SECOND

if TYPE_CHECKING:
    from coframe.transform.transform import Transform

__all__ = ["to_time", "to_transform_stamped"]


def to_time(stamp: int) -> Time:
    """Return a Time message for nanoseconds since the epoch."""
    seconds, nanoseconds = divmod(stamp, SECOND)
    return Time(sec=seconds, nanosec=nanoseconds)


def to_transform_stamped(parent: str, child: str, transform: Transform, stamp: int) -> TransformStamped:
    """Return a TransformStamped message with the pose of ``child`` in ``parent`` at ``stamp`` nanoseconds."""
    x, y, z, qx, qy, qz, qw = transform.values
    return TransformStamped(
        header=Header(stamp=to_time(stamp), frame_id=parent),
        child_frame_id=child,
        transform=TransformMessage(translation=Vector3(x=x, y=y, z=z), rotation=Quaternion(x=qx, y=qy, z=qz, w=qw)),
    )
