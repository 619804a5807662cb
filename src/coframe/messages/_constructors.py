# SPDX-License-Identifier: Apache-2.0
"""The source of message constructors, which set every field to its default before they read their arguments."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from coframe.messages._fields import number_of
from coframe.messages.definition import AbstractNestedType, AbstractType, Array, BasicType, NamespacedType

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from coframe.messages._parser import Field

__all__ = ["default_assignments"]


def default_assignments(fields: Iterable[Field], class_name: Callable[[NamespacedType], str]) -> list[str]:
    """Return the statements of ``__init__(self, **fields)`` that set the defaults.

    Args:
        fields: The fields of the message.
        class_name: Returns the name by which the source can use the class of another message.
    """
    return [f"self._{field.name} = {_default(field, class_name)}" for field in fields]


def _default(field: Field, class_name: Callable[[NamespacedType], str]) -> str:
    type_ = field.type
    number = number_of(type_)
    if field.default is not None:
        return _given_default(field.default, type_)
    if isinstance(type_, NamespacedType):
        return f'fields.get("{field.name}") or {class_name(type_)}()'
    if isinstance(type_, Array) and number:
        return f"np.zeros({type_.size}, np.{number.name})"
    if isinstance(type_, Array):
        return f"[{_zero_value(type_.value_type, class_name)} for _ in range({type_.size})]"
    if number:
        return f'array("{number.code}")'
    return "[]" if isinstance(type_, AbstractNestedType) else _zero_value(type_, class_name)


def _given_default(value: Any, type_: AbstractType) -> str:
    number = number_of(type_)
    if number is None:
        return _literal(value)
    if isinstance(type_, Array):
        return f"np.array({_literal(value)}, np.{number.name})"
    return f'array("{number.code}", {_literal(value)})'


def _literal(value: Any) -> str:
    """Return the expression for a value; Python has no literals for infinity and NaN."""
    if isinstance(value, list):
        return f"[{', '.join(map(_literal, value))}]"
    return f'float("{value}")' if isinstance(value, float) and not math.isfinite(value) else repr(value)


def _zero_value(type_: AbstractType, class_name: Callable[[NamespacedType], str]) -> str:
    if isinstance(type_, NamespacedType):
        return f"{class_name(type_)}()"
    if isinstance(type_, BasicType):
        zeros = {"boolean": "False", "octet": 'b"\\x00"', "float": "0.0", "double": "0.0"}
        return zeros.get(type_.typename, "0")
    return '""'
