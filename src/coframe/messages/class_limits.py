# SPDX-License-Identifier: Apache-2.0
"""Limits on messages: how large a message with default values, and the code that serializes it, can become.

A definition of a few bytes can ask for any amount of memory, such as ``string[4000000000] x``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.messages.definition import AbstractNestedType, AbstractType, Array, BasicType, NamespacedType
from coframe.messages.fields import number_of
from coframe.messages.registry import find

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["MOST_BYTES", "check_limits"]

MOST_BYTES = 64 << 20  # of a message with default values
_MOST_FIELDS = 20_000  # of a message and all messages inside it; public messages have fewer than 2 000
_MOST_LOOPS = 16  # sequences inside the messages of a sequence; Python allows 20 loops inside each other
_OBJECT = 64  # bytes of an object, roughly
_REFERENCE = 8


class _Extent(NamedTuple):
    """The memory of default values in bytes, the number of fields, and the depth of loops to serialize them."""

    size: int = _REFERENCE
    fields: int = 1
    loops: int = 0


_known: dict[str, _Extent] = {}  # by message type


def check_limits(types: Iterable[AbstractType]) -> None:
    """Raise ValueError if a message with fields of these types exceeds a limit."""
    extent = _sum(map(_extent, types))
    if extent.size > MOST_BYTES:
        raise ValueError(
            f"a message with default values would need {extent.size} bytes of memory, more than the limit of "
            f"{MOST_BYTES}; use a sequence such as float64[], which is empty by default"
        )
    if extent.fields > _MOST_FIELDS:
        raise ValueError(f"the message and those inside it have {extent.fields} fields, more than {_MOST_FIELDS}")
    if extent.loops > _MOST_LOOPS:
        raise ValueError(f"more than {_MOST_LOOPS} sequences inside each other")


def _extent(type_: AbstractType) -> _Extent:
    if isinstance(type_, NamespacedType):
        return _message_extent("/".join(type_.namespaced_name()))
    if not isinstance(type_, AbstractNestedType):
        return _Extent()
    number = number_of(type_)
    if number is not None:
        return _Extent(_OBJECT + (type_.size * number.dtype.itemsize if isinstance(type_, Array) else 0))
    inner = _extent(type_.value_type)
    count = type_.size if isinstance(type_, Array) else 0
    # The encoder writes booleans and octets without a loop.
    loops = inner.loops + (0 if isinstance(type_.value_type, BasicType) else 1)
    return _Extent(_OBJECT + count * (_REFERENCE + inner.size), inner.fields, loops)


def _message_extent(ros_type: str) -> _Extent:
    if ros_type not in _known:
        cls: Any = find(ros_type)
        _known[ros_type] = _sum(map(_extent, cls.SLOT_TYPES))
    return _known[ros_type]


def _sum(extents: Iterable[_Extent]) -> _Extent:
    listed = list(extents)
    return _Extent(
        _OBJECT + sum(extent.size for extent in listed),
        sum(extent.fields for extent in listed),
        max((extent.loops for extent in listed), default=0),
    )
