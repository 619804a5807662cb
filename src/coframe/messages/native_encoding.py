# SPDX-License-Identifier: Apache-2.0
"""The native encoder of a message class, which serializes messages whose fields have their usual Python types."""

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
from coframe.messages.layout import CODES
from coframe.messages.registry import find

if TYPE_CHECKING:
    from typing import TypeAlias

    Field: TypeAlias = tuple[str, str | _core.Encoder, int, int, int]

_SINGLE, _ARRAY, _SEQUENCE = range(3)
_TEXT = ""

_encoders: dict[type, _core.Encoder | None] = {}


def native_encoder(cls: Any) -> _core.Encoder | None:
    """Return the native encoder of a message class; None if it has fields that only Python code serializes."""
    if cls not in _encoders:
        try:
            fields = [_field(slot, type_) for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True)]
            _encoders[cls] = _core.Encoder(cls, fields)
        except TypeError:
            _encoders[cls] = None
    return _encoders[cls]


def _field(slot: str, type_: AbstractType) -> Field:
    if isinstance(type_, Array):
        return (slot, _item(type_.value_type), _ARRAY, type_.size, _text_bound(type_.value_type))
    if isinstance(type_, AbstractNestedType):
        assert isinstance(type_, AbstractSequence)
        size = type_.maximum_size if isinstance(type_, BoundedSequence) else 0
        return (slot, _item(type_.value_type), _SEQUENCE, size, _text_bound(type_.value_type))
    return (slot, _item(type_), _SINGLE, 0, _text_bound(type_))


def _item(type_: AbstractType) -> str | _core.Encoder:
    """Return the struct code of a number, the encoder of a message, or an empty text for texts.

    Raises:
        TypeError: Only Python code serializes this type.
    """
    if isinstance(type_, NamespacedType):
        if encoder := native_encoder(find("/".join(type_.namespaced_name()))):
            return encoder
    elif isinstance(type_, BasicType):
        if type_.typename != "octet":
            return CODES[type_.typename]
    elif not isinstance(type_, AbstractWString):
        return _TEXT
    raise TypeError(f"no native encoder for {type_}")


def _text_bound(type_: AbstractType) -> int:
    return type_.maximum_size if isinstance(type_, BoundedString) else 0
