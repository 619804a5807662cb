# SPDX-License-Identifier: Apache-2.0
"""Parse values of constants and defaults in interface definitions."""

from __future__ import annotations

import ast
import sys
from typing import Any

from coframe.messages.definition import (
    AbstractNestedType,
    AbstractType,
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    BoundedWString,
    NamespacedType,
    describe,
)
from coframe.messages.limits import check_digits

__all__ = ["check_value", "parse_literal"]

_BOOLEANS = {"true": True, "1": True, "false": False, "0": False}
_FLOAT32_BOUND = 3.402823466e38


def parse_literal(text: str, type_: AbstractType) -> Any:
    """Return the value of a literal in a ``.msg`` file.

    Raises:
        ValueError: The text is not a value of the type.
    """
    if isinstance(type_, AbstractNestedType):
        if not (text.startswith("[") and text.endswith("]")):
            raise ValueError(f"the default of {describe(type_)} must be a list such as [1, 2], not {text}")
        return check_value([_parse_scalar(item, type_.value_type) for item in _split_items(text)], type_)
    return check_value(_parse_scalar(text, type_), type_)


def check_value(value: Any, type_: AbstractType) -> Any:
    """Check that the type can hold a value, and return it as stored in messages.

    Raises:
        ValueError: The type cannot hold the value.
    """
    if isinstance(type_, AbstractNestedType):
        return _check_values(value, type_)
    if isinstance(type_, NamespacedType):
        text = f"a field of type {describe(type_)} cannot have a default: only numbers and strings can"
        raise ValueError(text)  # noqa: TRY004 - the definition is wrong, not the call
    if not isinstance(type_, BasicType):
        return _check_text(value, type_)
    if type_.typename == "boolean":
        return _require_fitting(value, isinstance(value, bool), "boolean")
    if type_.typename in {"float", "double"}:
        bound = _FLOAT32_BOUND if type_.typename == "float" else sys.float_info.max
        fits = isinstance(value, (int, float)) and not isinstance(value, bool)
        if fits:
            fits = abs(value) <= bound or value != value or abs(value) == float("inf")  # noqa: PLR0124 - NaN
        return float(_require_fitting(value, fits, type_.typename))
    return _check_integer(value, type_.typename)


def _require_fitting(value: Any, fits: object, type_name: str) -> Any:
    if not fits:
        raise ValueError(f"{value!r} is not a value of type {type_name}")
    return value


def _check_integer(value: Any, typename: str) -> Any:
    signed, _, digits = typename.partition("int")
    bits = int(digits or 8)
    low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if digits and signed != "u" else (0, 2**bits - 1)
    fits = isinstance(value, int) and not isinstance(value, bool) and low <= value <= high
    _require_fitting(value, fits, f"{typename} (from {low} to {high})")
    return bytes([value]) if typename == "octet" else value


def _check_text(value: Any, type_: AbstractType) -> str:
    _require_fitting(value, isinstance(value, str), describe(type_))
    if "\0" in value:
        raise ValueError("a string cannot contain a NUL character")
    if isinstance(type_, (BoundedString, BoundedWString)) and len(value) > type_.maximum_size:
        raise ValueError(f"{value!r} is longer than {describe(type_)} allows")
    return str(value)


def _check_values(values: Any, type_: AbstractNestedType) -> list[Any]:
    _require_fitting(values, isinstance(values, (list, tuple)), describe(type_))
    if isinstance(type_, Array) and len(values) != type_.size:
        raise ValueError(f"{describe(type_)} needs {type_.size} values, found {len(values)}")
    if isinstance(type_, BoundedSequence) and len(values) > type_.maximum_size:
        raise ValueError(f"{describe(type_)} can hold {type_.maximum_size} values, found {len(values)}")
    return [check_value(value, type_.value_type) for value in values]


def _parse_scalar(text: str, type_: AbstractType) -> Any:
    if isinstance(type_, NamespacedType):
        return text  # checked() explains why this is not possible.
    if not isinstance(type_, BasicType):
        return _unquote(text)
    if type_.typename == "boolean":
        return _BOOLEANS.get(text.lower(), text)
    check_digits(text)
    try:
        return float(text) if type_.typename in {"float", "double"} else _integer(text)
    except ValueError:
        raise ValueError(f"{text!r} is not a value of type {describe(type_)}") from None


def _integer(text: str) -> int:
    try:
        return int(text, 0)
    except ValueError:
        return int(text)  # Numbers such as 007, which rosidl allows.


def _unquote(text: str) -> str:
    if text[:1] not in {'"', "'"}:
        return text
    try:
        value = ast.literal_eval(text)
    except (ValueError, SyntaxError, MemoryError, RecursionError):
        value = None
    if not isinstance(value, str):
        raise ValueError(f"{text} is not a string in quotes")  # noqa: TRY004 - the definition is wrong, not the call
    return value


def _split_items(text: str) -> list[str]:
    """Return the items of a list. A comma inside quotes does not separate items."""
    items, item, quote = [], "", ""
    for character in text[1:-1]:
        if character == "," and not quote:
            items.append(item.strip())
            item = ""
            continue
        if character in {'"', "'"} and quote in {"", character}:
            quote = "" if quote else character
        item += character
    return [part for part in [*items, item.strip()] if part]
