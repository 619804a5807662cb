# SPDX-License-Identifier: Apache-2.0
"""Read stamps and frames from the first bytes of messages, without decoding the rest.

Most messages begin with a std_msgs/Header; some begin with a time, or with a sequence of messages that have a header.
Bytes that cannot be read never raise: the functions return None or the fallback instead. This applies to messages that
are cut short and to CDR messages whose encapsulation is not plain CDR (see :mod:`coframe.messages.encapsulation`).
"""

from __future__ import annotations

import struct
from enum import Enum
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe import time
from coframe.messages.definition import AbstractSequence, NamespacedType
from coframe.messages.encapsulation import HEADER_SIZE, byte_order
from coframe.messages.registry import find

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from coframe.messages.definition import AbstractType
    from coframe.messages.schema_classes import ResolvedSchema
    from coframe.messages.slices import Slices

__all__ = [
    "HEADER_BYTES",
    "STAMP_BYTES",
    "FirstStamp",
    "HeaderPeek",
    "StampReader",
    "begins_with_header",
    "first_stamp",
    "known_first_stamp",
    "peek_header",
    "stamp_reader",
]

HEADER_BYTES = 512  # enough of a message to contain its header: names of frames are short
STAMP_BYTES = 24  # enough of a message to contain its first stamp

# Representation identifiers, read as little-endian numbers.
_CDR_LE, _CDR_BE = 0x0100, 0x0000
# The halves of 8 bytes that contain a stamp.
_LOW, _HALF = np.uint64(0xFFFFFFFF), np.uint64(32)
_HEADER = "std_msgs/msg/Header"
_HEADER_FIELDS = (["stamp", "frame_id"], ["seq", "stamp", "frame_id"])  # of ROS 2 and of ROS 1
_TIME = "builtin_interfaces/msg/Time"


class HeaderPeek(NamedTuple):
    r"""The contents of a message's header.

    Attributes:
        stamp: In nanoseconds.
        frame: The frame_id as published; bytes that are not UTF-8 are shown as ``\xNN``.
    """

    stamp: int
    frame: str


class FirstStamp(Enum):
    """The beginning of a type's messages, if they begin with a stamp."""

    TIME = "a time"
    HEADER = "a header"
    HEADERS = "a sequence of messages that begin with a header"


# Offset of the stamp by encoding. In ROS 1, a header begins with a sequence number of 4 bytes.
_STAMP_OFFSETS = {
    "cdr": {
        FirstStamp.TIME: HEADER_SIZE,
        FirstStamp.HEADER: HEADER_SIZE,
        FirstStamp.HEADERS: HEADER_SIZE + 4,
    },
    "ros1": {FirstStamp.TIME: 0, FirstStamp.HEADER: 4, FirstStamp.HEADERS: 8},
}


def peek_header(message: bytes, encoding: str = "cdr") -> HeaderPeek | None:
    """Return the header that a message begins with, or None if it is damaged, cut short or not plain CDR.

    Args:
        message: The message, or its first bytes.
        encoding: ``"cdr"`` or ``"ros1"``.
    """
    order = byte_order(message) if encoding == "cdr" else "<"
    offset = _STAMP_OFFSETS[encoding][FirstStamp.HEADER]
    start = offset + 12
    if order is None or len(message) < start:
        return None
    seconds, nanoseconds, length = struct.unpack_from(order + "iII", message, offset)
    text = message[start : start + length]
    if len(text) < length:
        return None
    if encoding == "cdr":
        text, end = text[:-1], text[-1:]
        if end.strip(b"\0") or b"\0" in text:
            return None
    return HeaderPeek(seconds * time.SECOND + nanoseconds, text.decode("utf-8", "backslashreplace"))


def begins_with_header(ros_type: str) -> bool:
    """Return whether coframe has a class for the type whose messages begin with a header."""
    return known_first_stamp(ros_type) is FirstStamp.HEADER


def stamp_reader(ros_type: str, encoding: str = "cdr") -> StampReader | None:
    """Return a reader for the stamps of a type's messages, or None if coframe knows no stamp that they begin with.

    Args:
        ros_type: The type, such as ``sensor_msgs/msg/Imu``.
        encoding: ``"cdr"`` or ``"ros1"``. Messages in other encodings have no reader.
    """
    first = known_first_stamp(ros_type)
    return None if first is None or encoding not in _STAMP_OFFSETS else StampReader(first, encoding)


def known_first_stamp(ros_type: str) -> FirstStamp | None:
    """Return how the messages of a type begin, or None if that is not a known stamp."""
    return _first_field(_known_types(ros_type), _known_types)


def first_stamp(schema: ResolvedSchema) -> FirstStamp | None:
    """Return how the messages of a definition in a recording begin, or None if they do not begin with a stamp."""
    header = schema.structures.get(_HEADER)
    if header is not None and [field.name for field in header.fields] not in _HEADER_FIELDS:
        return None
    return _first_field(schema.types_of(schema.name), schema.types_of)


class StampReader:
    """Reads the first stamp in messages of one type.

    Args:
        first: The beginning of the messages.
        encoding: ``"cdr"`` or ``"ros1"``.
    """

    def __init__(self, first: FirstStamp, encoding: str) -> None:
        self._is_cdr = encoding == "cdr"
        self._offset = _STAMP_OFFSETS[encoding][first]
        # An empty sequence has no stamp: what follows its length is another field.
        self._length_offset = (HEADER_SIZE if self._is_cdr else 0) if first is FirstStamp.HEADERS else None

    def stamp(self, message: bytes) -> int | None:
        """Return the stamp of one message in nanoseconds, or None if it has none."""
        order = byte_order(message) if self._is_cdr else "<"
        if order is None or len(message) < self._offset + 8:
            return None
        if self._length_offset is not None and not any(message[self._length_offset : self._length_offset + 4]):
            return None
        seconds, nanoseconds = struct.unpack_from(order + ("iI" if self._is_cdr else "II"), message, self._offset)
        return int(seconds * time.SECOND + nanoseconds)

    def stamps(self, messages: Slices, fallback: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the stamps of many messages.

        Args:
            messages: Their bytes; the first :data:`STAMP_BYTES` of each are enough.
            fallback: The value for messages without a stamp, (N,) nanoseconds.

        Returns:
            (N,) nanoseconds.
        """
        starts, ends = messages.starts.astype(np.int64), messages.ends.astype(np.int64)
        stamps: NDArray[np.int64] = np.array(fallback)
        rows = np.flatnonzero(starts + self._offset + 8 <= ends)
        is_little: NDArray[np.bool_] | None = None
        if self._is_cdr:
            identifiers = _overlapping_view(messages.data, "<u2")[starts[rows]]
            is_plain = (identifiers == _CDR_LE) | (identifiers == _CDR_BE)
            rows, is_little = rows[is_plain], identifiers[is_plain] == _CDR_LE
        if self._length_offset is not None:
            has_elements = _overlapping_view(messages.data, "<u4")[starts[rows] + self._length_offset] != 0
            rows, is_little = rows[has_elements], None if is_little is None else is_little[has_elements]
        words = _overlapping_view(messages.data, "<u8")[starts[rows] + self._offset]
        seconds, nanoseconds = words & _LOW, words >> _HALF
        if is_little is not None and not is_little.all():
            swapped = words.byteswap()
            seconds = np.where(is_little, seconds, swapped >> _HALF)
            nanoseconds = np.where(is_little, nanoseconds, swapped & _LOW)
        # Seconds are signed in ROS 2 and unsigned in ROS 1.
        whole = seconds.astype(np.uint32).view(np.int32) if self._is_cdr else seconds
        stamps[rows] = whole.astype(np.int64) * time.SECOND + nanoseconds.astype(np.int64)
        return stamps


def _overlapping_view(data: bytes, kind: str) -> NDArray[Any]:
    """Return a view of bytes as numbers that begin at each byte."""
    size = np.dtype(kind).itemsize
    if len(data) < size:
        return np.empty(0, kind)
    view: NDArray[Any] = np.ndarray((len(data) - size + 1,), kind, data, strides=(1,))
    return view


def _message_class(ros_type: str) -> Any:
    try:
        return find(ros_type)
    except LookupError:
        return None


def _first_field(types: Sequence[AbstractType], types_of: Callable[[str], Sequence[AbstractType]]) -> FirstStamp | None:
    """Return how a message with fields of these types begins.

    Args:
        types: The types of its fields.
        types_of: Returns the types of the fields of another message.
    """
    first = types[0] if types else None
    if isinstance(first, AbstractSequence) and isinstance(first.value_type, NamespacedType):
        element = types_of("/".join(first.value_type.namespaced_name()))
        is_stamped = _first_field(element, types_of) is FirstStamp.HEADER
        return FirstStamp.HEADERS if is_stamped else None
    if not isinstance(first, NamespacedType):
        return None
    return {_HEADER: FirstStamp.HEADER, _TIME: FirstStamp.TIME}.get("/".join(first.namespaced_name()))


def _known_types(ros_type: str) -> Sequence[AbstractType]:
    cls = _message_class(ros_type)
    return () if cls is None else tuple(cls.SLOT_TYPES)
