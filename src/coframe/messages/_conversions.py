# SPDX-License-Identifier: Apache-2.0
"""The values that messages of ROS 2 Jazzy and later also accept: NumPy's numbers and arrays, and iterables of numbers.

Jazzy's generated classes do not check the types of values, so programs assign NumPy arrays, and integers to fields of
floating-point numbers. Values that cannot be converted are errors.
"""

from __future__ import annotations

import operator
import os
from array import array
from typing import TYPE_CHECKING, Any

import coframe.lazy_numpy as np
from coframe.distributions import since
from coframe.messages.definition import AbstractNestedType, AbstractString, AbstractType, Array, BasicType

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["CONVERTS", "conversion"]

CONVERTS = since("field_conversions") and os.environ.get("ROS_PYTHON_CHECK_FIELDS") != "1"
"""Whether fields convert values; ``ROS_PYTHON_CHECK_FIELDS=1`` asks for exact types, as in ROS 2."""

_FLOATS = {"float", "double"}
_NOT_NUMBERS = (str, bytes, bytearray, dict)


def conversion(type_: AbstractType, code: str) -> Callable[[Any], Any] | None:
    """Return the conversion of values of other types for a field, or None if its type has none.

    The conversion raises TypeError, ValueError or OverflowError for what it cannot convert.

    Args:
        type_: The type of the field.
        code: The type code of array.array for the numbers of an array or a sequence, "" for other types.
    """
    if isinstance(type_, BasicType):
        return _of_item(type_)
    if not isinstance(type_, AbstractNestedType):
        return None
    if isinstance(type_.value_type, AbstractString):
        return _to_list_of_text
    item = _of_item(type_.value_type) if isinstance(type_.value_type, BasicType) else None
    if item is None:
        return None
    convert_item, is_array = item, isinstance(type_, Array)

    def convert(value: Any) -> Any:
        if isinstance(value, _NOT_NUMBERS):
            raise TypeError
        if np.is_array(value) and code:
            numbers = _numbers(value.reshape(-1) if is_array else value, np.dtype(code))
            return numbers if is_array else array(code, numbers.tobytes())
        values: Iterable[Any] = value
        return [convert_item(each) for each in values]

    return convert


def _numbers(value: np.ndarray[Any, Any], dtype: np.dtype[Any]) -> np.ndarray[Any, Any]:
    """Return the row of numbers as another type, if all of them fit."""
    if value.ndim != 1 or value.dtype.kind not in ("fiu" if dtype.kind == "f" else "iu"):
        raise TypeError
    if dtype.kind != "f" and value.size:
        bounds = np.iinfo(dtype)
        if value.min() < bounds.min or value.max() > bounds.max:
            raise OverflowError
    with np.errstate(over="ignore"):  # As in array.array, too large numbers become infinite.
        return np.ascontiguousarray(value, dtype)


def _of_item(type_: BasicType) -> Callable[[Any], Any] | None:
    if type_.typename in _FLOATS:
        return _to_float
    if type_.typename == "boolean":
        return _to_bool
    return operator.index if "int" in type_.typename else None


def _to_float(value: Any) -> float:
    if isinstance(value, _NOT_NUMBERS) or np.is_array(value):
        raise TypeError
    return float(value)


def _to_bool(value: Any) -> bool:
    if not (np.is_scalar(value) and isinstance(value, np.bool_)):
        raise TypeError
    return bool(value)


def _to_list_of_text(value: Any) -> list[Any]:
    if not np.is_array(value):
        raise TypeError
    items: list[Any] = value.tolist()
    return items
