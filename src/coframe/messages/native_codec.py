# SPDX-License-Identifier: Apache-2.0
"""The native codec of a message class, which reads and writes messages whose fields have their usual Python types."""

from __future__ import annotations

import functools
import struct
from typing import TYPE_CHECKING, Any

from coframe import _core
from coframe.messages._fields import number_of
from coframe.messages._layout import CODES, ros1_prefix
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
from coframe.messages.registry import class_of

if TYPE_CHECKING:
    from typing import TypeAlias

    import numpy as np

    Field: TypeAlias = tuple[str, str | _core.MessageCodec, int, int, int, np.dtype[Any] | None]

_SINGLE, _ARRAY, _SEQUENCE = range(3)
_TEXT = ""

_MAX_RECORDED = 256  # classes of definitions in recordings whose codecs are kept, with the classes

_codecs: dict[type, _core.MessageCodec | None] = {}


def native_codec(cls: Any) -> _core.MessageCodec | None:
    """Return the native codec of a message class, or None if it has fields that only Python code supports."""
    if cls.__recorded__:
        return _recorded_codec(cls)
    if cls not in _codecs:
        _codecs[cls] = _new_codec(cls)
    return _codecs[cls]


def _new_codec(cls: Any) -> _core.MessageCodec | None:
    try:
        fields = [_field(slot, type_) for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True)]
        return _core.MessageCodec(cls, fields, struct.calcsize(f"<{ros1_prefix(cls)}"))
    except TypeError:
        return None


_recorded_codec = functools.lru_cache(_MAX_RECORDED)(_new_codec)


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
    """Return the struct code of a number, the codec of a message, or an empty string for strings.

    Raises:
        TypeError: Only Python code handles this type.
    """
    if isinstance(type_, NamespacedType):
        if codec := native_codec(class_of(type_)):
            return codec
    elif isinstance(type_, BasicType):
        if type_.typename != "octet":
            return CODES[type_.typename]
    elif not isinstance(type_, AbstractWString):
        return _TEXT
    raise TypeError(f"no native codec for {type_}")


def _text_bound(type_: AbstractType) -> int:
    return type_.maximum_size if isinstance(type_, BoundedString) else 0
