# SPDX-License-Identifier: Apache-2.0
"""The native codec of a message class, which reads and writes messages whose fields have their usual Python types."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe import _core
from coframe.messages.definition import (
    AbstractNestedType,
    AbstractSequence,
    AbstractType,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    NamespacedType,
)
from coframe.messages.fields import number_of
from coframe.messages.layout import CODES
from coframe.messages.registry import find

if TYPE_CHECKING:
    from typing import TypeAlias

    import numpy as np

    Field: TypeAlias = tuple[str, str | _core.MessageCodec, int, int, int, np.dtype[Any] | None]

_SINGLE, _ARRAY, _SEQUENCE = range(3)
_TEXT = ""

_codecs: dict[type, _core.MessageCodec | None] = {}


def native_codec(cls: Any) -> _core.MessageCodec | None:
    """Return the native codec of a message class; None if it has fields that only Python code handles."""
    if cls not in _codecs:
        try:
            fields = [_field(slot, type_) for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True)]
            _codecs[cls] = _core.MessageCodec(cls, fields)
        except TypeError:
            _codecs[cls] = None
    return _codecs[cls]


def _field(slot: str, type_: AbstractType) -> Field:
    if isinstance(type_, Array):
        number = number_of(type_)
        dtype = number.dtype if number else None
        return (slot, _item(type_.value_type), _ARRAY, type_.size, _text_bound(type_.value_type), dtype)
    if isinstance(type_, AbstractNestedType):
        assert isinstance(type_, AbstractSequence)
        size = type_.maximum_size if isinstance(type_, BoundedSequence) else 0
        return (slot, _item(type_.value_type), _SEQUENCE, size, _text_bound(type_.value_type), None)
    return (slot, _item(type_), _SINGLE, 0, _text_bound(type_), None)


def _item(type_: AbstractType) -> str | _core.MessageCodec:
    """Return the struct code of a number, the codec of a message, or an empty text for texts.

    Raises:
        TypeError: Only Python code handles this type.
    """
    if isinstance(type_, NamespacedType):
        if codec := native_codec(find("/".join(type_.namespaced_name()))):
            return codec
    elif isinstance(type_, BasicType):
        if type_.typename != "octet":
            return CODES[type_.typename]
    elif not isinstance(type_, AbstractWString):
        return _TEXT
    raise TypeError(f"no native codec for {type_}")


def _text_bound(type_: AbstractType) -> int:
    return type_.maximum_size if isinstance(type_, BoundedString) else 0
