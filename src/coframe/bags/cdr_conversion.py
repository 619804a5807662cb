# SPDX-License-Identifier: Apache-2.0
"""Conversion of recorded messages to CDR: those of ROS 1 are converted if ROS 2 has the type."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

from coframe.bags.decoding import fits_humble, humble_store, ros2_name
from coframe.messages import deserialize, find

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags.storage import Channel
    from coframe.messages.generated.geometry_msgs.msg import TransformStamped

__all__ = ["cdr_converter", "decode_transforms"]


def cdr_converter(channel: Channel) -> tuple[str, Callable[[bytes], bytes]] | None:
    """Return the ROS 2 type of a channel and the function that converts its messages to CDR.

    Returns:
        None if the messages cannot be converted. The function raises an Exception if the bytes are damaged.
    """
    if channel.encoding == "cdr":
        return channel.type, bytes
    if channel.encoding != "ros1":
        return None
    name = ros2_name(channel.type)
    if not fits_humble(channel.type, channel.definition):
        return None
    return name, functools.partial(_from_ros1, name)


def decode_transforms(convert: Callable[[bytes], bytes], data: bytes) -> list[TransformStamped]:
    """Return the transforms of a TFMessage; an empty list if it is damaged.

    Args:
        convert: The function of :func:`cdr_converter`.
        data: The message as recorded.
    """
    try:
        return list(deserialize(convert(data), find("tf2_msgs/msg/TFMessage")).transforms)
    except Exception:  # noqa: BLE001 - rosbags raises errors of many kinds; reading the message itself reports them
        return []


def _from_ros1(name: str, data: bytes) -> bytes:
    return bytes(humble_store().ros1_to_cdr(data, name))
