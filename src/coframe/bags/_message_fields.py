# SPDX-License-Identifier: Apache-2.0
"""Change the frame names and stamps in messages of any type. Other bytes are not changed where possible.

Nearly all messages have one header, at their beginning. Its stamp is changed in place. A frame name of another length
moves the rest of the message, which is copied if the numbers in it stay aligned. Other messages are decoded and
encoded.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

from coframe.bags._recorded_types import UnknownTypeError
from coframe.bags.message_frames import FrameNames
from coframe.errors import DecodeError
from coframe.messages import deserialize, serialize
from coframe.messages.definition import AbstractNestedType, Array, BasicType, NamespacedType
from coframe.messages.encapsulation import BYTE_ORDERS, HEADER_SIZE
from coframe.messages.registry import class_of
from coframe.messages.schema_classes import known_class
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags.storage import Channel
    from coframe.messages.definition import AbstractType

__all__ = ["MAX_STAMP", "FrameFields", "StampFields"]

MAX_STAMP = (1 << 31) * SECOND
"""Stamps are below this number of nanoseconds, because their seconds have 31 bits."""

_NAME_LENGTH = HEADER_SIZE + 8  # offset of the length of the frame name in a message that begins with a header
_NAME = _NAME_LENGTH + 4
_SIZES = {"boolean": 1, "octet": 1, "int8": 1, "uint8": 1, "int16": 2, "uint16": 2, "float": 4, "double": 8}
_SIZES |= {"int32": 4, "uint32": 4, "int64": 8, "uint64": 8}
_HEADER, _TIME = "std_msgs/msg/Header", "builtin_interfaces/msg/Time"

_Plan = dict[str, "_Plan | None"]


class FrameFields:
    """The frame names in the messages of one type.

    Args:
        cls: The class of the messages.
    """

    def __init__(self, cls: Any) -> None:
        self._class = cls
        self._all = FrameNames(cls)
        self._tail = _tail_alignment(cls) if self._all.only_in_header else None
        self._has_header_first = bool(cls.SLOT_TYPES) and _name(cls.SLOT_TYPES[0]) == _HEADER

    @classmethod
    def of(cls, channel: Channel, types: RecordedTypes) -> FrameFields | None:
        """Return the frame names of a channel's messages, or None if they have none or cannot be decoded."""
        message_class = _class_of(channel, types)
        return cls(message_class) if message_class is not None and FrameNames(message_class).exist else None

    @property
    def is_quick(self) -> bool:
        """Whether the only frame name is in the first bytes of the messages."""
        return self._tail is not None

    def rename(self, data: bytes, rename: Callable[[str], str]) -> tuple[bytes, int]:
        """Replace the frame names in a message.

        Returns:
            The new message, and the number of names that changed.

        Raises:
            DecodeError: The bytes are damaged.
        """
        if self._tail is None:
            return self._all.rename(data, rename)
        order, old, end = _first_frame(data)
        new = rename(str(old, "utf-8", "surrogateescape")).encode("utf-8", "surrogateescape")
        if new == old:
            return data, 0
        first, largest = self._tail
        start = end + (HEADER_SIZE - end) % first
        new_end = _NAME + len(new) + 1
        new_start = new_end + (HEADER_SIZE - new_end) % first
        if (new_start - start) % largest:
            return self._all.rename(data, rename)
        length = struct.pack(f"{order}I", len(new) + 1)
        return b"".join((data[:_NAME_LENGTH], length, new, bytes(new_start - new_end + 1), data[start:])), 1

    def of_header(self, data: bytes) -> str:
        """Return the frame that the header of a message names, or "" if it has no header.

        Raises:
            DecodeError: The bytes are damaged.
        """
        if self._has_header_first:
            return str(_first_frame(data)[1], "utf-8", "backslashreplace")
        header = getattr(deserialize(data, self._class), "header", None)
        return str(getattr(header, "frame_id", ""))

    def names(self, data: bytes) -> set[str]:
        """Return the frame names in a message.

        Raises:
            DecodeError: The bytes are damaged.
        """
        found: set[str] = set()

        def note(name: str) -> str:
            found.add(name)
            return name

        self._all.rename(data, note)
        return found


class StampFields:
    """The stamps in the messages of one type: those of headers, and all other times.

    Args:
        cls: The class of the messages.
    """

    def __init__(self, cls: Any) -> None:
        self._class = cls
        self._plan = _stamps(cls, {})
        self._is_first = bool(cls.SLOT_TYPES) and _name(cls.SLOT_TYPES[0]) in {_HEADER, _TIME}
        self._is_alone = self._is_first and list(self._plan) == [cls.__slots__[0][1:]]

    @classmethod
    def of(cls, channel: Channel, types: RecordedTypes) -> StampFields | None:
        """Return the stamps of a channel's messages, or None if they have none or cannot be decoded."""
        return cls.of_class(_class_of(channel, types))

    @classmethod
    def of_class(cls, message_class: Any) -> StampFields | None:
        """Return the stamps of messages, or None if they have no stamps or their class is unknown (None)."""
        return cls(message_class) if message_class is not None and _stamps(message_class, {}) else None

    @property
    def is_leading(self) -> bool:
        """Whether the messages begin with a stamp."""
        return self._is_first

    def first(self, data: bytes) -> int:
        """Return the stamp at the beginning of a message in nanoseconds, if :attr:`is_leading`.

        Raises:
            DecodeError: The bytes are damaged.
        """
        return _read_stamp(data)[1]

    def change(self, data: bytes, change: Callable[[int], int]) -> tuple[bytes, int]:
        """Replace the stamps in a message, except stamps of 0, which were never set.

        Args:
            data: The message.
            change: Maps a stamp in nanoseconds to its new value.

        Returns:
            The new message, and the number of stamps that changed.

        Raises:
            DecodeError: The bytes are damaged.
        """
        if not self._is_alone:
            message = deserialize(data, self._class)
            change_count = _change_stamps(message, self._plan, change)
            return (serialize(message), change_count) if change_count else (data, 0)
        order, old = _read_stamp(data)
        new = change(old) if old else old
        if new == old:
            return data, 0
        stamp = struct.pack(f"{order}iI", *divmod(new, SECOND))
        return b"".join((data[:HEADER_SIZE], stamp, data[HEADER_SIZE + 8 :])), 1


def _class_of(channel: Channel, types: RecordedTypes) -> Any:
    """Return the class of the messages of a channel in CDR, or None if it is unknown."""
    if channel.encoding != "cdr":
        return None
    if not channel.definition and (known := known_class(channel.type)) is not None:
        return known
    try:
        return types.message_class(channel)
    except UnknownTypeError:
        return None


def _first_frame(data: bytes) -> tuple[str, bytes, int]:
    """Return the byte order of a message that begins with a header, its frame name, and where the name ends."""
    order = BYTE_ORDERS.get(data[:2])
    if order is None or len(data) < _NAME:
        raise DecodeError("the message is not plain CDR, or is truncated")
    (length,) = struct.unpack_from(f"{order}I", data, _NAME_LENGTH)
    end = _NAME + length
    if end > len(data) or (length and data[end - 1]):
        raise DecodeError("the frame name is longer than the message, or has no end")
    return order, data[_NAME : max(end - 1, _NAME)], end


def _read_stamp(data: bytes) -> tuple[str, int]:
    order = BYTE_ORDERS.get(data[:2])
    if order is None or len(data) < HEADER_SIZE + 8:
        raise DecodeError("the message is not plain CDR, or is truncated")
    seconds, nanoseconds = struct.unpack_from(f"{order}iI", data, HEADER_SIZE)
    return order, seconds * SECOND + nanoseconds


def _tail_alignment(cls: Any) -> tuple[int, int]:
    """Return the alignment of the first number after the header of a message, and the largest one."""
    alignments = [one for type_ in cls.SLOT_TYPES[1:] for one in _alignments(type_, {})]
    return (alignments[0], max(alignments)) if alignments else (1, 1)


def _alignments(type_: AbstractType, known: dict[Any, tuple[int, ...]]) -> tuple[int, ...]:
    """Return the alignment of the first number of a value, and the largest one."""
    if isinstance(type_, Array):
        return _alignments(type_.value_type, known)
    if isinstance(type_, AbstractNestedType):  # The length of a sequence has 4 bytes.
        return 4, max(4, *_alignments(type_.value_type, known))
    if isinstance(type_, BasicType):
        return (_SIZES.get(type_.typename, 8),)
    if not isinstance(type_, NamespacedType):
        return (4,)
    cls = class_of(type_)
    if cls not in known:
        inner = [one for each in cls.SLOT_TYPES for one in _alignments(each, known)] or [1]
        known[cls] = (inner[0], max(inner))
    return known[cls]


def _stamps(cls: Any, known: dict[Any, _Plan]) -> _Plan:
    """Return the fields of a class that are times (None) or contain times."""
    if cls not in known:
        plan: _Plan = {}
        for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True):
            inner = type_.value_type if isinstance(type_, AbstractNestedType) else type_
            if _name(inner) == _TIME:
                plan[slot[1:]] = None
            elif isinstance(inner, NamespacedType) and (inner_plan := _stamps(class_of(inner), known)):
                plan[slot[1:]] = inner_plan
        known[cls] = plan
    return known[cls]


def _change_stamps(message: Any, plan: _Plan, change: Callable[[int], int]) -> int:
    change_count = 0
    for name, inner in plan.items():
        value = getattr(message, name)
        for part in value if isinstance(value, list) else [value]:
            if inner is not None:
                change_count += _change_stamps(part, inner, change)
            elif (old := part.sec * SECOND + part.nanosec) and (new := change(old)) != old:
                part.sec, part.nanosec = divmod(new, SECOND)
                change_count += 1
    return change_count


def _name(type_: AbstractType) -> str:
    return "/".join(type_.namespaced_name()) if isinstance(type_, NamespacedType) else ""
