# SPDX-License-Identifier: Apache-2.0
"""The attributes of messages: values that their setters accept, convert and reject.

The rules and error messages are the same as in Humble's generated classes. Since Jazzy, other numbers are converted
(`_conversions`). The checks are disabled by ``python -O`` and
by the environment variable ``ROS_PYTHON_CHECK_FIELDS=0``.
"""

from __future__ import annotations

import os
from array import array
from collections import UserList, UserString
from collections.abc import Callable, Collection, Iterable, Sequence
from collections.abc import Set as AbstractSet
from functools import cached_property
from math import isinf
from operator import attrgetter
from struct import calcsize
from typing import Any

import coframe.lazy_numpy as np
from coframe.messages._conversions import CONVERTS, conversion
from coframe.messages.definition import (
    AbstractNestableType,
    AbstractNestedType,
    AbstractType,
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    BoundedWString,
    NamespacedType,
    UnboundedString,
)
from coframe.messages.registry import class_of

CHECKS_FIELDS = __debug__ and os.environ.get("ROS_PYTHON_CHECK_FIELDS", "1") != "0"

# Converts a value that a user assigns to the value that the message stores.
Check = Callable[[Any], Any]
# Stores a value in a field of a message.
Setter = Callable[[Any, Any], None]


class NumberFormat:
    """The Python representation of a number type.

    Attributes:
        code: The type code of array.array.
        name: The name of NumPy's dtype.
        itemsize: The size of a number in bytes.
    """

    def __init__(self, code: str, name: str) -> None:
        self.code = code
        self.name = name
        self.itemsize = calcsize(f"={code}")

    @cached_property
    def dtype(self) -> np.dtype[Any]:
        """NumPy's dtype."""
        return np.dtype(self.name)


NUMBERS = {
    "float": NumberFormat("f", "float32"),
    "double": NumberFormat("d", "float64"),
    "int8": NumberFormat("b", "int8"),
    "uint8": NumberFormat("B", "uint8"),
    "int16": NumberFormat("h", "int16"),
    "uint16": NumberFormat("H", "uint16"),
    "int32": NumberFormat("i", "int32"),
    "uint32": NumberFormat("I", "uint32"),
    "int64": NumberFormat("q", "int64"),
    "uint64": NumberFormat("Q", "uint64"),
}
_FLOAT32_BOUND = 3.402823466e38
_FLOAT64_BOUND = 1.7976931348623157e308


def attribute(name: str, type_: AbstractType, slot: Any) -> Any:
    """Return the descriptor of ``message.name``, which stores its value in the slot ``_name``."""
    if not CHECKS_FIELDS and number_of(type_) is None:
        return slot
    check, store = _check(name, type_), slot.__set__

    def assign(message: object, value: Any) -> None:
        store(message, check(value))

    number = number_of(type_)
    convert = conversion(type_, number.code if number else "") if CONVERTS and CHECKS_FIELDS else None

    def convert_and_assign(message: object, value: Any) -> None:
        try:
            checked = check(value)
        except AssertionError:
            assert convert is not None
            try:
                converted = convert(value)
            except (TypeError, ValueError, OverflowError):
                converted = None
            if converted is None:
                raise
            checked = check(converted)
        store(message, checked)

    setter = _fast_setter(type_, store, assign if convert is None else convert_and_assign)
    return property(attrgetter(f"_{name}"), setter, doc=f"Message field '{name}'.")


def _fast_setter(type_: AbstractType, store: Setter, slow: Setter) -> Setter:
    """Return a setter that stores the usual values without further calls, and leaves all others to the slow one."""
    if isinstance(type_, BasicType) and "int" in type_.typename:
        low, high = _integer_bounds(type_)

        def assign_integer(message: object, value: Any) -> None:
            if type(value) is int and low <= value <= high:
                store(message, value)
            else:
                slow(message, value)

        return assign_integer
    if type_ not in (BasicType("boolean"), BasicType("double"), UnboundedString()):
        return slow
    usual = _python_type(type_)

    def assign(message: object, value: Any) -> None:
        if type(value) is usual:
            store(message, value)
        else:
            slow(message, value)

    return assign


def number_of(type_: AbstractType) -> NumberFormat | None:
    """Return how the numbers of an array or sequence of numbers are stored, or None for other types."""
    if isinstance(type_, AbstractNestedType) and isinstance(type_.value_type, BasicType):
        return NUMBERS.get(type_.value_type.typename)
    return None


def constructor_setter(type_: AbstractType, descriptor: Any) -> Setter:
    """Return what stores a constructor's argument in a field: constructors accept numbers in any iterable."""
    setter: Any = descriptor.fset if isinstance(descriptor, property) else descriptor.__set__
    assign: Setter = setter
    number = number_of(type_)
    if number is None:
        return assign
    convert = _constructor_conversion(type_, number)
    return lambda message, values: assign(message, convert(values))


def _constructor_conversion(type_: AbstractType, number: NumberFormat) -> Check:
    if not isinstance(type_, Array):
        return lambda values: _number_sequence(number, values)
    shape = (type_.size,)

    def to_numpy(values: Any) -> Any:
        result = np.array(values, dtype=number.dtype)
        assert result.size != type_.size or result.shape == shape, f"expected one row of {type_.size} numbers"
        return result

    return to_numpy


def _number_sequence(number: NumberFormat, values: Iterable[Any]) -> array[Any]:
    if np.is_array(values):
        values = values.tolist()  # Faster: array.array would read one NumPy scalar after another.
    return array(number.code, values)


def _check(name: str, type_: AbstractType) -> Check:
    if isinstance(type_, AbstractNestedType):
        return _nested_check(name, type_)
    if isinstance(type_, NamespacedType):
        return _message_check(name, type_)
    if isinstance(type_, BasicType):
        return _basic_check(name, type_)
    if isinstance(type_, (BoundedString, BoundedWString)):
        return _bounded_text_check(name, type_.maximum_size)
    return _instance_check(name, str)


def _nested_check(name: str, type_: AbstractNestedType) -> Check:
    number = number_of(type_)
    if number is None:
        return _values_check(name, type_)
    if isinstance(type_, Array):
        return _number_array_check(name, type_, number)
    return _number_sequence_check(name, type_, number)


def _basic_check(name: str, type_: BasicType) -> Check:
    if type_.typename == "octet":
        return _octet_check(name)
    if type_.typename == "float":
        return _float32_check(name)
    if "int" in type_.typename:
        return _integer_check(name, type_)
    return _instance_check(name, _python_type(type_))


def _python_type(type_: AbstractType) -> Any:
    if isinstance(type_, NamespacedType):
        return class_of(type_)
    if isinstance(type_, BasicType):
        return {"boolean": bool, "octet": bytes, "float": float, "double": float}.get(type_.typename, int)
    return str


def _instance_check(name: str, python_type: type) -> Check:
    # This check is enough for `double`, too: every Python float is in its range.
    def check(value: Any) -> Any:
        assert isinstance(value, python_type), f"The '{name}' field must be of type '{python_type.__name__}'"
        return value

    return check


def _message_check(name: str, type_: NamespacedType) -> Check:
    message_type = _python_type(type_)

    def check(value: Any) -> Any:
        assert isinstance(value, message_type), f"The '{name}' field must be a sub message of type '{type_.name}'"
        return value

    return check


def _bounded_text_check(name: str, maximum_size: int) -> Check:
    def check(value: Any) -> Any:
        fits = isinstance(value, (str, UserString)) and len(value) <= maximum_size
        assert fits, f"The '{name}' field must be string value not longer than {maximum_size}"
        return value

    return check


def _octet_check(name: str) -> Check:
    def check(value: Any) -> Any:
        fits = isinstance(value, (bytes, bytearray)) and len(value) == 1
        assert fits, f"The '{name}' field must be of type 'bytes' or 'ByteString' with length 1"
        return value

    return check


def _integer_bounds(type_: BasicType) -> tuple[int, int]:
    bits = int(type_.typename.partition("int")[2])
    return (0, 2**bits - 1) if type_.typename.startswith("u") else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)


def _integer_check(name: str, type_: BasicType) -> Check:
    low, high = _integer_bounds(type_)
    kind = "an integer" if low else "an unsigned integer"

    def check(value: Any) -> Any:
        assert isinstance(value, int), f"The '{name}' field must be of type 'int'"
        assert low <= value <= high, f"The '{name}' field must be {kind} in [{low}, {high}]"
        return value

    return check


def _fits_float32(value: float) -> bool:
    return not (value < -_FLOAT32_BOUND or value > _FLOAT32_BOUND) or isinf(value)


def _float32_check(name: str) -> Check:
    def check(value: Any) -> Any:
        assert isinstance(value, float), f"The '{name}' field must be of type 'float'"
        assert _fits_float32(value), f"The '{name}' field must be a float in [{-_FLOAT32_BOUND}, {_FLOAT32_BOUND}]"
        return value

    return check


def _number_array_check(name: str, type_: Array, number: NumberFormat) -> Check:
    check_values = _values_check(name, type_)

    def check(value: Any) -> Any:
        if np.is_array(value):
            assert not CHECKS_FIELDS or value.dtype == number.dtype, (
                f"The '{name}' numpy.ndarray() must have the dtype of 'numpy.{number.name}'"
            )
            assert not CHECKS_FIELDS or value.size == type_.size, (
                f"The '{name}' numpy.ndarray() must have a size of {type_.size}"
            )
            return value
        return np.array(check_values(value), dtype=number.dtype)

    return check


def _number_sequence_check(name: str, type_: AbstractNestedType, number: NumberFormat) -> Check:
    check_values = _values_check(name, type_)
    maximum_size = type_.maximum_size if isinstance(type_, BoundedSequence) else None

    def check(value: Any) -> Any:
        if isinstance(value, array):
            assert not CHECKS_FIELDS or value.typecode == number.code, (
                f"The '{name}' array.array() must have the type code of '{number.code}'"
            )
            assert not CHECKS_FIELDS or maximum_size is None or len(value) <= maximum_size, (
                f"The '{name}' array.array() must have a size <= {maximum_size}"
            )
            return value
        if number.code == "B" and isinstance(value, (bytes, bytearray)) and maximum_size is None:
            return array("B", value)  # Bytes are always in the range of uint8.
        return _number_sequence(number, check_values(value))

    return check


def _values_check(name: str, type_: AbstractNestedType) -> Check:
    if not CHECKS_FIELDS:
        return lambda value: value
    value_type = type_.value_type
    python_type = _python_type(value_type)
    value_fits = _value_rule(value_type)

    def check(value: Any) -> Any:
        fits = (
            _is_collection(value)
            and _size_fits(value, type_)
            and ({*map(type, value)} <= {python_type} or all(isinstance(item, python_type) for item in value))
            and value_fits(value)
        )
        assert fits, _type_error_text(name, type_, python_type.__name__)
        return value

    return check


def _is_collection(value: Any) -> bool:
    if type(value) is list:  # Faster than the checks below.
        return True
    return isinstance(value, (Sequence, AbstractSet, UserList)) and not isinstance(value, (str, UserString))


def _size_fits(value: Collection[Any], type_: AbstractNestedType) -> bool:
    if isinstance(type_, Array):
        return len(value) == type_.size
    return not isinstance(type_, BoundedSequence) or len(value) <= type_.maximum_size


def _value_rule(type_: AbstractNestableType) -> Callable[[Collection[Any]], bool]:
    """Return the check of all values together, after the check of their Python type."""
    if isinstance(type_, (BoundedString, BoundedWString)):
        longest = type_.maximum_size
        return lambda values: all(len(value) <= longest for value in values)
    if isinstance(type_, BasicType) and "int" in type_.typename:
        low, high = _integer_bounds(type_)
        return lambda values: not values or (min(values) >= low and max(values) <= high)
    if isinstance(type_, BasicType) and type_.typename == "float":
        return _fit_float32
    return lambda _values: True


def _fit_float32(values: Collection[float]) -> bool:
    # If max() starts with a NaN or finds an infinity, the second, slower check decides.
    return max(map(abs, values), default=0.0) <= _FLOAT32_BOUND or all(map(_fits_float32, values))


def _type_error_text(name: str, type_: AbstractNestedType, type_name: str) -> str:
    value_type = type_.value_type
    rules = ["a set or sequence"]
    if isinstance(type_, Array):
        rules.append(f"with length {type_.size}")
    if isinstance(type_, BoundedSequence):
        rules.append(f"with length at most {type_.maximum_size}")
    if isinstance(value_type, (BoundedString, BoundedWString)):
        rules.append(f"and each string value not longer than {value_type.maximum_size}")
    rules.append(f"and each value of type '{type_name}'")
    if isinstance(value_type, BasicType) and "int" in value_type.typename:
        low, high = _integer_bounds(value_type)
        rules.append(f"and each {'integer' if low else 'unsigned integer'} in [{low}, {high}]")
    if isinstance(value_type, BasicType) and value_type.typename in {"float", "double"}:
        bound = _FLOAT32_BOUND if value_type.typename == "float" else _FLOAT64_BOUND
        rules.append(f"and each {value_type.typename} in [{-bound:f}, {bound:f}]")
    return f"The '{name}' field must be {' '.join(rules)}"
