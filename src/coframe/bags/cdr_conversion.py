# SPDX-License-Identifier: Apache-2.0
"""Conversion of recorded messages to CDR: those of ROS 1 are converted if ROS 2 has the type."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.errors import DecodeError
from coframe.messages import deserialize, find, serialize
from coframe.messages.codec import deserialize_ros1

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags.recorded_types import RecordedTypes
    from coframe.bags.storage import Channel
    from coframe.messages.generated.geometry_msgs.msg import TransformStamped

__all__ = ["cdr_converter", "copied_definition", "decode_transforms"]


def cdr_converter(channel: Channel, types: RecordedTypes) -> tuple[str, Callable[[bytes], bytes]] | None:
    """Return the ROS 2 type of a channel and the function that converts its messages to CDR.

    Returns:
        None if the messages cannot be converted. The function raises an Exception if the bytes are damaged.
    """
    if channel.encoding == "cdr":
        return channel.type, bytes
    if channel.encoding != "ros1":
        return None
    cls = types.own_class(channel)
    if cls is None:
        return None
    return cls.ROS_TYPE, lambda data: serialize(deserialize_ros1(data, cls))


def copied_definition(channel: Channel, types: RecordedTypes) -> tuple[str | None, str]:
    """Return the definition for a copy of a channel whose messages stay as they are, and its format.

    Returns:
        None in place of the definition for that of coframe: DDS's IDL has names that differ from that of the type.
    """
    if channel.definition_format == "omgidl" and types.own_class(channel) is not None:
        return None, "ros2msg"
    return channel.definition.decode("utf-8", "replace") or None, channel.definition_format or "ros2msg"


def decode_transforms(convert: Callable[[bytes], bytes], data: bytes) -> list[TransformStamped]:
    """Return the transforms of a TFMessage; an empty list if it is damaged.

    Args:
        convert: The function of :func:`cdr_converter`.
        data: The message as recorded.
    """
    kind: Any = find("tf2_msgs/msg/TFMessage")
    try:
        return list(deserialize(convert(data), kind).transforms)
    except (DecodeError, ValueError):  # Reading the message itself reports the damage.
        return []
