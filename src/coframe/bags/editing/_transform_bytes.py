# SPDX-License-Identifier: Apache-2.0
"""Split TFMessages into transforms and join them again. The bytes of unedited parts are preserved."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING

from coframe.errors import DecodeError
from coframe.messages.encapsulation import BYTE_ORDERS, HEADER_SIZE
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["POSE", "RecordedTransform", "join_transforms", "split_transforms"]

POSE = struct.Struct("<7d")
"""The values of a transform in :attr:`RecordedTransform.pose`: x, y, z, qx, qy, qz, qw."""
_MIN_SIZE = 76  # bytes of a transform with empty names
_STRING_ENDS = [bytes(1 + size) for size in range(8)]  # the NUL of a string, and padding


@dataclass(slots=True)
class RecordedTransform:
    """One transform of a TFMessage.

    Attributes:
        stamp: In nanoseconds.
        parent: Name of the parent frame in UTF-8, as published.
        child: Name of the child frame in UTF-8, as published.
        pose: x, y, z in meters and qx, qy, qz, qw, as bytes in the byte order of the message.
    """

    stamp: int
    parent: bytes
    child: bytes
    pose: bytes


def split_transforms(data: bytes) -> list[RecordedTransform]:
    """Return the transforms of a TFMessage in CDR.

    Raises:
        DecodeError: The bytes are damaged.
    """
    order = BYTE_ORDERS.get(data[:2])
    if order is None:
        raise DecodeError("the encapsulation is not plain CDR (00 01 or 00 00)")
    head, length_of = struct.Struct(f"{order}iII").unpack_from, struct.Struct(f"{order}I").unpack_from
    try:
        (number,) = length_of(data, HEADER_SIZE)
        if number * _MIN_SIZE > len(data):
            raise DecodeError(f"a TFMessage of {len(data)} bytes claims to have {number} transforms")
        found, position = [], 2 * HEADER_SIZE
        for _ in range(number):
            seconds, nanoseconds, length = head(data, position)
            start = position + 12
            end = start + length
            parent = data[start:end]
            start = end + (-end & 3)
            (length,) = length_of(data, start)
            start += 4
            end = start + length
            child = data[start:end]
            start = end + (HEADER_SIZE - end & 7)
            position = start + POSE.size
            if position > len(data) or parent[-1:] != b"\0" or child[-1:] != b"\0":
                raise DecodeError("a TFMessage is truncated, or a name in it has no end")
            stamp = seconds * SECOND + nanoseconds
            found.append(RecordedTransform(stamp, parent[:-1], child[:-1], data[start:position]))
    except struct.error:
        raise DecodeError("a TFMessage is truncated") from None
    return found


def join_transforms(transforms: Sequence[RecordedTransform], header: bytes) -> bytes:
    """Return the TFMessage with these transforms.

    Args:
        transforms: The transforms.
        header: The encapsulation header, 4 bytes; its byte order is that of the poses.
    """
    order = BYTE_ORDERS[header[:2]]
    head, length_of = struct.Struct(f"{order}iII").pack, struct.Struct(f"{order}I").pack
    out = bytearray(header[:HEADER_SIZE]) + length_of(len(transforms))
    for transform in transforms:
        seconds, nanoseconds = divmod(transform.stamp, SECOND)
        out += head(seconds, nanoseconds, len(transform.parent) + 1)
        out += transform.parent
        out += _STRING_ENDS[-(len(out) + 1) & 3]
        out += length_of(len(transform.child) + 1)
        out += transform.child
        out += _STRING_ENDS[HEADER_SIZE - (len(out) + 1) & 7]
        out += transform.pose
    return bytes(out)
