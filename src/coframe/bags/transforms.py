# SPDX-License-Identifier: Apache-2.0
"""Ingest recorded transforms into a buffer: TFMessages as bytes, other types after decoding."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe import _core, time
from coframe.bags._json_transforms import StampedValues, json_many, json_one
from coframe.messages.encapsulation import HEADER_SIZE, byte_order
from coframe.messages.tf_columns import TransformColumns, tf_columns
from coframe.type_names import TF_MESSAGE, TF_MESSAGES_OF_ROS1

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.bags.storage import Channel
    from coframe.buffer import Buffer
    from coframe.messages.slices import Slices

__all__ = ["Ingest", "has_unknown_encoding", "ingest_for", "is_static"]

# Offset of the first parent's name in a TFMessage: after the count, the stamp, the length of the name, and the
# encapsulation (CDR) or the sequence number (ROS 1).
_FIRST_PARENT_OFFSET = 20
_EARLIEST, _LATEST = -(1 << 63), (1 << 63) - 1  # nanoseconds
# The exceptions that the decoding functions below raise for damaged bytes.
_DAMAGE_ERRORS = (
    struct.error,
    ValueError,
    TypeError,
    KeyError,
    IndexError,
    AttributeError,
    OverflowError,
    RecursionError,
)


class Ingest:
    """Ingests the messages of one channel into a buffer.

    Args:
        decode: Decodes a message; for TFMessages, which the buffer decodes itself, their encoding.
        static: Whether the transforms are static.
        authority: The authority of the transforms in the buffer.
        renaming: Maps frame names to their names in the buffer; None keeps the names.
    """

    def __init__(
        self,
        decode: Callable[[bytes | memoryview], Iterator[StampedValues]] | str,
        static: bool,
        authority: str,
        renaming: _core.Renaming | None,
    ) -> None:
        self._decode = decode
        self.static = static
        self._authority = authority
        self._renaming = renaming

    def names_begin_with_slash(self, messages: Slices) -> bool:
        """Return whether the first parent in any TFMessage begins with a slash, or False for other types."""
        if not isinstance(self._decode, str):
            return False
        offsets = messages.starts + np.uint64(_FIRST_PARENT_OFFSET)
        offsets = offsets[offsets < messages.ends]
        return bool((np.frombuffer(messages.data, dtype=np.uint8)[offsets] == ord("/")).any())

    def __call__(self, buffer: Buffer, messages: Slices) -> tuple[int, str]:
        """Ingest messages, each completely or not at all.

        Returns:
            The number of damaged messages, and what is wrong with the first one.
        """
        if isinstance(self._decode, str):
            slices = (messages.data, messages.starts, messages.ends)
            return _core.ingest_slices(buffer, *slices, self.static, self._authority, self._decode, self._renaming)
        damaged, reason = 0, ""
        for message in messages.each():
            try:
                for transform in self._transforms(self._decode, message):
                    self._store(buffer, transform)
            except _DAMAGE_ERRORS as error:
                damaged, reason = damaged + 1, reason or f"{type(error).__name__}: {error}"
        return damaged, reason

    def columns(self, messages: Slices) -> TransformColumns:
        """Return the transforms of messages as columns."""
        if isinstance(self._decode, str):
            return tf_columns(messages, self._decode)
        rows: list[tuple[int, StampedValues]] = []
        damaged = 0
        for number, message in enumerate(messages.each()):
            try:
                rows += [(number, transform) for transform in self._transforms(self._decode, message)]
            except _DAMAGE_ERRORS:
                damaged += 1
        numbers: dict[str, int] = {}
        pairs = [[numbers.setdefault(name, len(numbers)) for name in (row.parent, row.child)] for _, row in rows]
        parent, child = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
        return TransformColumns(
            np.array([number for number, _ in rows], dtype=np.int64),
            np.array([row.stamp or 0 for _, row in rows], dtype=np.int64),
            parent,
            child,
            np.array([row.values for _, row in rows], dtype=np.float64).reshape(-1, 7),
            list(numbers),
            damaged,
        )

    def _transforms(
        self, decode: Callable[[bytes | memoryview], Iterator[StampedValues]], message: bytes | memoryview
    ) -> list[StampedValues]:
        transforms = list(decode(message))
        for transform in transforms:
            if transform.stamp is None and not self.static:
                raise ValueError("a transform has no timestamp")
            if not _EARLIEST <= (transform.stamp or 0) <= _LATEST:
                raise ValueError("a stamp is outside the range of ROS time")
            for name in (transform.parent, transform.child):
                if not isinstance(name, str):  # JSON can contain anything
                    raise TypeError("a frame name is not a string")
                name.encode()  # fails for half of a surrogate pair, which is not a character
        return transforms

    def _store(self, buffer: Buffer, transform: StampedValues) -> None:
        names = (transform.parent, transform.child)
        parent, child = names if self._renaming is None else map(self._renaming, names)
        stamp = transform.stamp or 0
        buffer._set_values(parent, child, stamp, *transform.values, self.static, self._authority)


def is_static(topic: str) -> bool:
    """Return whether a topic contains static transforms."""
    return topic.rpartition("/")[2] == "tf_static"


def ingest_for(channel: Channel, renaming: _core.Renaming | None = None) -> Ingest | None:
    """Return the Ingest for a channel's messages, or None if they are not transforms."""
    kind = (channel.encoding, channel.type.replace("/msg/", "/"))
    if kind not in _DECODINGS:
        return None
    return Ingest(_DECODINGS[kind], is_static(channel.topic), channel.topic, renaming)


def has_unknown_encoding(channel: Channel) -> bool:
    """Return whether the messages of a channel are transforms in an encoding that cannot be read."""
    type_ = channel.type.replace("/msg/", "/")
    if type_ == _ONE_TRANSFORM and channel.encoding in {"cdr", "ros1"}:
        return (
            False  # In ROS, such as from a motion capture system, it is a message on a topic and not part of the tree.
        )
    return ingest_for(channel) is None and type_ in {each for _, each in _DECODINGS}


def _foxglove_cdr(data: bytes | memoryview) -> Iterator[StampedValues]:
    """Decode a foxglove_msgs/FrameTransform, which has no count at the beginning, unlike a TFMessage."""
    order = byte_order(data)
    if order is None:
        raise ValueError("the encapsulation is not plain CDR (00 01 or 00 00)")
    body = data[HEADER_SIZE:]
    seconds, nanoseconds = struct.unpack_from(order + "iI", body)
    position, names = 8, []
    for _ in range(2):
        position = (position + 3) & ~3
        (length,) = struct.unpack_from(order + "I", body, position)
        if position + 4 + length > len(body):
            raise ValueError("a string is longer than the message")
        names.append(str(body[position + 4 : position + 4 + length], "utf-8").removesuffix("\0"))
        position += 4 + length
    values = struct.unpack_from(order + "7d", body, (position + 7) & ~7)
    yield StampedValues(names[0], names[1], seconds * time.SECOND + nanoseconds, values)


def _protobuf_many(data: bytes | memoryview) -> Iterator[StampedValues]:
    """Decode foxglove.FrameTransforms: field 1 is repeated."""
    for number, value in _fields(data):
        if number == 1:
            yield from _protobuf_one(value)


def _protobuf_one(data: bytes | memoryview) -> Iterator[StampedValues]:
    """Decode foxglove.FrameTransform: fields 1 to 5 are timestamp, parent, child, translation and rotation."""
    parts = dict(_fields(data))
    t, q = (dict(_fields(parts.get(number, b""))) for number in (4, 5))
    x, y, z = (_read_double(t.get(number)) for number in (1, 2, 3))
    qx, qy, qz, qw = (_read_double(q.get(number)) for number in (1, 2, 3, 4))
    names = [str(parts.get(number, b""), "utf-8") for number in (2, 3)]
    stamp = _protobuf_time(parts[1]) if 1 in parts else None
    yield StampedValues(names[0], names[1], stamp, (x, y, z, qx, qy, qz, qw))


def _protobuf_time(data: Any) -> int:
    """Decode a google.protobuf.Timestamp. Its fields are omitted if they are 0."""
    fields = dict(_fields(data))
    seconds = (fields.get(1, 0) + (1 << 63)) % (1 << 64) - (1 << 63)  # two's complement in 64 bits
    return int(seconds * time.SECOND + fields.get(2, 0))


def _read_double(value: Any) -> float:
    return 0.0 if value is None else float(struct.unpack("<d", value)[0])


def _fields(data: Any) -> Iterator[tuple[int, Any]]:
    """Yield number and value of each field of a protobuf message: integers, or bytes for other types."""
    position = 0
    while position < len(data):
        key, position = _varint(data, position)
        if key & 7 == 0:
            value: Any
            value, position = _varint(data, position)
        else:
            size, position = _varint(data, position) if key & 7 == 2 else ({1: 8, 5: 4}[key & 7], position)
            if position + size > len(data):
                raise ValueError("a field is longer than the message")
            value = data[position : position + size]
            position += size
        yield key >> 3, value


def _varint(data: Any, position: int) -> tuple[int, int]:
    value = 0
    for shift in range(0, 64, 7):
        byte = data[position]
        position += 1
        value |= (byte & 0x7F) << shift
        if byte < 0x80:
            return value, position
    raise ValueError("an integer has more than 64 bits")


# By encoding and type. In CDR, foxglove_msgs/FrameTransforms has the layout of a TFMessage.
_ONE_TRANSFORM = "geometry_msgs/TransformStamped"
_DECODINGS: dict[tuple[str, str], Callable[[bytes | memoryview], Iterator[StampedValues]] | str] = {
    ("cdr", TF_MESSAGE.replace("/msg/", "/")): "cdr",
    ("cdr", "foxglove_msgs/FrameTransforms"): "cdr",
    ("cdr", "foxglove_msgs/FrameTransform"): _foxglove_cdr,
    **{("ros1", name): "ros1" for name in TF_MESSAGES_OF_ROS1},
    ("protobuf", "foxglove.FrameTransform"): _protobuf_one,
    ("protobuf", "foxglove.FrameTransforms"): _protobuf_many,
    ("json", "foxglove.FrameTransform"): json_one,
    ("json", "foxglove.FrameTransforms"): json_many,
    ("json", "foxglove/FrameTransform"): json_one,
    ("json", "foxglove/FrameTransforms"): json_many,
    ("json", "foxglove_msgs/FrameTransform"): json_one,
    ("json", "foxglove_msgs/FrameTransforms"): json_many,
    ("json", _ONE_TRANSFORM): json_one,
    **{("json", name): json_many for name in TF_MESSAGES_OF_ROS1},
}
