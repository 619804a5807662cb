# SPDX-License-Identifier: Apache-2.0
"""Checks how large a message with default values, and the code that serializes it, can become.

A definition of a few bytes, of a user or in a recording, can ask for any amount of memory, such as
``string[4000000000] x``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.messages._fields import number_of
from coframe.messages.definition import AbstractNestedType, AbstractType, Array, BasicType, NamespacedType
from coframe.messages.limits import MAX_BYTES, MAX_FIELDS, MAX_LOOPS
from coframe.messages.registry import find

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["check_limits"]

_OBJECT = 64  # bytes of an object, roughly
_REFERENCE = 8


class _Extent(NamedTuple):
    """The memory of default values in bytes, the number of fields, and the depth of loops to serialize them."""

    size: int = _REFERENCE
    fields: int = 1
    loops: int = 0


class _Extents:
    """Computes extents of types, each message type once.

    Args:
        fields_of: Returns the types of the fields of a message type.
    """

    def __init__(self, fields_of: Callable[[str], Iterable[AbstractType]]) -> None:
        self._fields_of = fields_of
        self._known_extents: dict[str, _Extent] = {}  # by message type

    def total(self, types: Iterable[AbstractType]) -> _Extent:
        """Return the extent of a message with fields of these types."""
        listed = [self._extent_of_type(type_) for type_ in types]
        return _Extent(
            _OBJECT + sum(extent.size for extent in listed),
            sum(extent.fields for extent in listed),
            max((extent.loops for extent in listed), default=0),
        )

    def _extent_of_type(self, type_: AbstractType) -> _Extent:
        if isinstance(type_, NamespacedType):
            return self._extent_of_message("/".join(type_.namespaced_name()))
        if not isinstance(type_, AbstractNestedType):
            return _Extent()
        number = number_of(type_)
        if number is not None:
            return _Extent(_OBJECT + (type_.size * number.itemsize if isinstance(type_, Array) else 0))
        inner = self._extent_of_type(type_.value_type)
        count = type_.size if isinstance(type_, Array) else 0
        # The encoder writes booleans and octets without a loop.
        loops = inner.loops + (0 if isinstance(type_.value_type, BasicType) else 1)
        return _Extent(_OBJECT + count * (_REFERENCE + inner.size), inner.fields, loops)

    def _extent_of_message(self, ros_type: str) -> _Extent:
        if ros_type not in self._known_extents:
            self._known_extents[ros_type] = self.total(self._fields_of(ros_type))
        return self._known_extents[ros_type]


def _slot_types(ros_type: str) -> Iterable[AbstractType]:
    cls: Any = find(ros_type)
    types: tuple[AbstractType, ...] = cls.SLOT_TYPES
    return types


_registered = _Extents(_slot_types)


def check_limits(
    types: Iterable[AbstractType], fields_of: Callable[[str], Iterable[AbstractType]] | None = None
) -> None:
    """Raise ValueError if a message with fields of these types exceeds a limit.

    Args:
        types: The types of the fields.
        fields_of: Returns the types of the fields of a message type inside the message; None: those of coframe's class.
    """
    extent = (_registered if fields_of is None else _Extents(fields_of)).total(types)
    if extent.size > MAX_BYTES:
        raise ValueError(
            f"a message with default values would need {extent.size} bytes of memory; the maximum is "
            f"{MAX_BYTES}. Use a sequence such as float64[], which is empty by default"
        )
    if extent.fields > MAX_FIELDS:
        raise ValueError(f"the message and those inside it have {extent.fields} fields; the maximum is {MAX_FIELDS}")
    if extent.loops > MAX_LOOPS:
        raise ValueError(f"sequences are nested more than {MAX_LOOPS} levels deep")
