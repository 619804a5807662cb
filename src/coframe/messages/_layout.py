# SPDX-License-Identifier: Apache-2.0
"""Positions of numbers in CDR and in messages of ROS 1.

CDR (XCDR1) aligns every number to its own size, counted from the end of the 4-byte encapsulation header. The offsets
after a string are not known exactly, but after the next 4-byte length they are multiples of four again.
Messages of ROS 1 have no padding.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.messages._fields import NUMBERS
from coframe.messages.definition import AbstractType, Array, BasicType, NamespacedType
from coframe.messages.encapsulation import HEADER_SIZE
from coframe.messages.registry import class_of

if TYPE_CHECKING:
    from collections.abc import Callable

CODES = {"boolean": "?", "octet": "c", **{name: number.code for name, number in NUMBERS.items()}}
EMPTY_STRUCT_CODE = "B"  # C has no empty structures, so rosidl adds one byte to messages without fields.
ROS1_PREFIX = "I"  # Headers of ROS 1 begin with a sequence number, which those of ROS 2 do not have.
_SIZES = {code: struct.calcsize(f"<{code}") for code in "?cbBhHiIqQfd"}


class Offset(NamedTuple):
    """The known part of an offset: its remainder modulo 1, 2, 4 or 8."""

    modulus: int
    remainder: int

    def __add__(self, size: int) -> Offset:  # type: ignore[override]
        return Offset(self.modulus, (self.remainder + size) % self.modulus)

    def __or__(self, other: Offset) -> Offset:
        modulus = min(self.modulus, other.modulus)
        while self.remainder % modulus != other.remainder % modulus:
            modulus //= 2
        return Offset(modulus, self.remainder % modulus)

    def starts(self, alignment: int) -> list[int]:
        """Return the remainders modulo `alignment` that the offset can have."""
        step = min(self.modulus, alignment)
        return list(range(self.remainder % step, alignment, step))


class Run(NamedTuple):
    """Adjacent numbers, preceded by the NUL of a string if there is one, with a layout for each possible start."""

    layouts: dict[int, struct.Struct]
    alignment: int
    end: Offset

    def by_offset(self, entry: Callable[[struct.Struct], Any]) -> tuple[Any, ...]:
        """Return the entries of the layouts, indexed by the offset from the first byte modulo the alignment."""
        starts = ((index - HEADER_SIZE) % self.alignment for index in range(self.alignment))
        return tuple(entry(self.layouts[start]) if start in self.layouts else None for start in starts)


def ros1_prefix(cls: Any) -> str:
    """Return the struct codes of the data that a ROS 1 message has before the fields of its class."""
    return ROS1_PREFIX if cls.ROS_TYPE == "std_msgs/msg/Header" and not cls.__recorded__ else ""


def plan_run(codes: str, start: Offset, order: str, *, after_text: bool, is_ros1: bool = False) -> Run:
    """Return the layouts of adjacent numbers for every offset that they can start at."""
    if is_ros1:
        return Run({0: struct.Struct(order + codes)}, 1, start)
    alignment = max((_SIZES[code] for code in codes), default=1)
    layouts: dict[int, struct.Struct] = {}
    end: Offset | None = None
    for first in start.starts(alignment):
        position, text = first, order
        if after_text:
            position, text = position + 1, text + "x"
        for code in codes:
            padding = -position % _SIZES[code]
            position += padding + _SIZES[code]
            text += "x" * padding + code
        layouts[first] = struct.Struct(text)
        reached = Offset(max(start.modulus, alignment), 0) + position
        if start.modulus > alignment:
            reached = start + (position - first)
        end = reached if end is None else end | reached
    assert end is not None
    return Run(layouts, alignment, end)


def smallest_size(type_: AbstractType) -> int:
    """Return the smallest size of a value in bytes; at least 1, so that lengths can be checked against the data."""
    if isinstance(type_, NamespacedType):
        cls = class_of(type_)
        return max(1, sum(map(smallest_size, cls.SLOT_TYPES)))
    if isinstance(type_, Array):
        return type_.size * smallest_size(type_.value_type)
    return _SIZES[CODES[type_.typename]] if isinstance(type_, BasicType) else 4
