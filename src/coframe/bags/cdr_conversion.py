# SPDX-License-Identifier: Apache-2.0
"""Convert recorded ROS 1 messages to CDR."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.bags._recorded_types import UnknownTypeError
from coframe.errors import DecodeError
from coframe.messages import Message, deserialize, find, serialize
from coframe.messages.codec import deserialize_ros1
from coframe.messages.definition import AbstractNestedType, NamespacedType
from coframe.messages.definition_texts import recorded_definition
from coframe.messages.registry import class_of
from coframe.messages.schema_classes import known_class
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags.storage import Channel
    from coframe.messages.generated.geometry_msgs.msg import TransformStamped

__all__ = ["Conversion", "cdr_conversion", "copied_definition", "decode_transforms"]


class Conversion(NamedTuple):
    """The conversion of a channel's messages to ROS 2 messages in CDR.

    Attributes:
        type: The ROS 2 type.
        definition: Its definition, as ``ros2msg``, or None for coframe's definition.
        convert: Converts the bytes of a message. It raises an Exception if they are damaged.
    """

    type: str
    definition: str | None
    convert: Callable[[bytes], bytes]


def cdr_conversion(channel: Channel, types: RecordedTypes) -> Conversion | None:
    """Return how the messages of a channel are converted to CDR, or None if that is not possible.

    If coframe's type has other fields, fields are matched by name, and new fields have default values. A type that
    coframe does not have, such as your own, keeps its name and fields.
    """
    if channel.encoding == "cdr":
        return Conversion(channel.type, None, bytes)
    if channel.encoding != "ros1":
        return None
    try:
        recorded = types.message_class(channel)
        known = known_class(recorded.ROS_TYPE)
        unknown = None if known else recorded_definition(recorded, types.schema(channel))
    except UnknownTypeError:
        return None
    if known is not None and not _has_fields(known, recorded):
        return None

    def convert(data: bytes) -> bytes:
        message = deserialize_ros1(data, recorded)
        return serialize(message if known is None else _with_fields(known, message))

    return Conversion(recorded.ROS_TYPE if known is None else known.ROS_TYPE, unknown, convert)


def _has_fields(cls: Any, recorded: Any) -> bool:
    """Return whether a class has all fields of a recorded one, ignoring case."""
    if recorded is cls:
        return True
    own, theirs = _message_classes(cls), _message_classes(recorded)
    return own.keys() >= theirs.keys() and all(
        inner is None or (own[name] is not None and _has_fields(own[name], inner)) for name, inner in theirs.items()
    )


def _with_fields(cls: Any, message: Any) -> Any:
    """Copy the values of a message to a new message of a class with the same fields."""
    if isinstance(message, cls):
        return message
    names = {slot.lower(): slot[1:] for slot in cls.__slots__}
    inner = _message_classes(cls)
    converted = cls()
    for slot in message.__slots__:
        value = getattr(message, slot)
        if isinstance(value, Message):
            value = _with_fields(inner[slot.lower()], value)
        elif isinstance(value, list) and value and isinstance(value[0], Message):
            value = [_with_fields(inner[slot.lower()], each) for each in value]
        setattr(converted, names[slot.lower()], value)
    return converted


def _message_classes(cls: Any) -> dict[str, Any]:
    """Return the class of the messages in each field, None for other fields, by the slot in lower case."""
    found: dict[str, Any] = {}
    for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True):
        inner = type_.value_type if isinstance(type_, AbstractNestedType) else type_
        found[slot.lower()] = class_of(inner) if isinstance(inner, NamespacedType) else None
    return found


def copied_definition(channel: Channel, types: RecordedTypes) -> tuple[str | None, str]:
    """Return the definition and its format for a copy of a channel whose messages are copied unchanged.

    Returns:
        The definition is None for coframe's own, because the names in DDS IDL differ from the type name.
    """
    if channel.definition_format == "omgidl" and types.own_class(channel) is not None:
        return None, "ros2msg"
    return channel.definition.decode("utf-8", "replace") or None, channel.definition_format or "ros2msg"


def decode_transforms(convert: Callable[[bytes], bytes], data: bytes) -> list[TransformStamped]:
    """Return the transforms of a TFMessage, or an empty list if it is damaged.

    Args:
        convert: The function of :func:`cdr_conversion`.
        data: The message as recorded.
    """
    kind: Any = find(TF_MESSAGE)
    try:
        return list(deserialize(convert(data), kind).transforms)
    except (DecodeError, ValueError):  # The damage is reported when the message itself is read.
        return []
