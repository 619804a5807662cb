"""Recorded messages as ROS 2 sends them: those of ROS 1 are turned into CDR where ROS 2 has the type."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

from coframe.bags.decoding import fits_humble, humble_store, ros2_name
from coframe.messages import deserialize, find

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags.storage import Channel
    from coframe.messages.generated.geometry_msgs.msg import TransformStamped

__all__ = ["as_cdr", "transforms_of"]


def as_cdr(channel: Channel) -> tuple[str, Callable[[bytes], bytes]] | None:
    """The ROS 2 type of a channel, and what turns its messages into CDR; None where that is not possible.

    Raises:
        Exception: (What is returned, when it is called.) The bytes are damaged.
    """
    if channel.encoding == "cdr":
        return channel.type, bytes
    if channel.encoding != "ros1":
        return None
    name = ros2_name(channel.type)
    if not fits_humble(channel.type, channel.definition):
        return None
    return name, functools.partial(_from_ros1, name)


def transforms_of(convert: Callable[[bytes], bytes], data: bytes) -> list[TransformStamped]:
    """The transforms in a message of them; none of a damaged one, which is told of when it is dealt with itself.

    Args:
        convert: As `as_cdr` gives it.
        data: The message as it was recorded.
    """
    try:
        return list(deserialize(convert(data), find("tf2_msgs/msg/TFMessage")).transforms)
    except Exception:  # noqa: BLE001 - the libraries have many ways to say that bytes are damaged
        return []


def _from_ros1(name: str, data: bytes) -> bytes:
    return bytes(humble_store().ros1_to_cdr(data, name))
