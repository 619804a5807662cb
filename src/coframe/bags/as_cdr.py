"""Recorded messages as ROS 2 sends them: those of ROS 1 are turned into CDR where ROS 2 has the type."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

from coframe.bags.decoding import fits_humble, humble_store, ros2_name

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags.storage import Channel

__all__ = ["as_cdr"]


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


def _from_ros1(name: str, data: bytes) -> bytes:
    return bytes(humble_store().ros1_to_cdr(data, name))
