# SPDX-License-Identifier: Apache-2.0
"""Parameters, which have a name and a value of one of nine types."""

from __future__ import annotations

import array
from enum import IntEnum
from typing import Any, Final, Generic, TypeVar

from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterType, ParameterValue
from rclpy import _yaml

T = TypeVar("T")

PARAMETER_SEPARATOR_STRING: Final = "."
_INT64: Final = range(-(2**63), 2**63)


class Parameter(Generic[T]):
    """A parameter with a typed value.

    Args:
        name: Name of the parameter.
        type_: Type of the parameter. None: the type of the value.
        value: Value of the parameter.

    Raises:
        TypeError: `type_` is not a Parameter.Type, or the value is not of a parameter type.
        ValueError: The value is not of the type.
    """

    class Type(IntEnum):
        """Type of a parameter."""

        NOT_SET = ParameterType.PARAMETER_NOT_SET
        BOOL = ParameterType.PARAMETER_BOOL
        INTEGER = ParameterType.PARAMETER_INTEGER
        DOUBLE = ParameterType.PARAMETER_DOUBLE
        STRING = ParameterType.PARAMETER_STRING
        BYTE_ARRAY = ParameterType.PARAMETER_BYTE_ARRAY
        BOOL_ARRAY = ParameterType.PARAMETER_BOOL_ARRAY
        INTEGER_ARRAY = ParameterType.PARAMETER_INTEGER_ARRAY
        DOUBLE_ARRAY = ParameterType.PARAMETER_DOUBLE_ARRAY
        STRING_ARRAY = ParameterType.PARAMETER_STRING_ARRAY

        @classmethod
        def from_parameter_value(cls, parameter_value: Any) -> Parameter.Type:
            """Return the parameter type of a Python value. An empty list is a byte array, as in upstream rclpy.

            Raises:
                TypeError: The value is not of a parameter type.
            """
            for kind in cls:
                if kind.check(parameter_value):
                    return kind
            raise TypeError(
                f"The given value is not one of the allowed types '{parameter_value}'. A list needs elements of one "
                "type: bool, int, float, str or bytes of length 1."
            )

        def check(self, parameter_value: Any) -> bool:
            """Return whether a Python value has this parameter type."""
            value = parameter_value
            if self is Parameter.Type.NOT_SET:
                return value is None
            if self in _ITEM_TYPES:
                return _is_sequence_of(_ITEM_TYPES[self], value)
            if self is Parameter.Type.INTEGER:
                return isinstance(value, int) and not isinstance(value, bool) and value in _INT64
            return isinstance(value, _SCALAR_TYPES[self])

    def __init__(self, name: str, type_: Parameter.Type | None = None, value: T | None = None) -> None:
        if type_ is None:
            type_ = Parameter.Type.from_parameter_value(value)
        if not isinstance(type_, Parameter.Type):
            raise TypeError(f"type must be an instance of '{Parameter.Type!r}'")
        if not type_.check(value):
            raise ValueError(f"Type '{type_}' and value '{value}' do not agree")
        self._name = name
        self._type_ = type_
        self._value: Any = value

    @classmethod
    def from_parameter_msg(cls, param_msg: ParameterMsg) -> Parameter[Any]:
        """Create a parameter from an `rcl_interfaces/Parameter`."""
        return cls(param_msg.name, Parameter.Type(param_msg.value.type), parameter_value_to_python(param_msg.value))

    @property
    def name(self) -> str:
        """The name of the parameter."""
        return self._name

    @property
    def type_(self) -> Parameter.Type:
        """The type of the parameter."""
        return self._type_

    @property
    def value(self) -> Any:
        """The value of the parameter, None for NOT_SET."""
        return self._value

    def get_parameter_value(self) -> ParameterValue:
        """Return the value as an `rcl_interfaces/ParameterValue`."""
        message = ParameterValue(type=int(self.type_))
        if (field := _VALUE_FIELDS.get(self.type_)) is not None:
            setattr(message, field, self.value)
        return message

    def to_parameter_msg(self) -> ParameterMsg:
        """Return the parameter as an `rcl_interfaces/Parameter`."""
        return ParameterMsg(name=self.name, value=self.get_parameter_value())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Parameter):
            return NotImplemented
        return (self.name, self.type_, self.value) == (other.name, other.type_, other.value)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"Parameter(name={self.name!r}, type_={self.type_!s}, value={self.value!r})"


_SCALAR_TYPES: Final = {
    Parameter.Type.BOOL: bool,
    Parameter.Type.DOUBLE: float,
    Parameter.Type.STRING: str,
}
_ITEM_TYPES: Final[dict[Parameter.Type, type]] = {
    Parameter.Type.BYTE_ARRAY: bytes,
    Parameter.Type.BOOL_ARRAY: bool,
    Parameter.Type.INTEGER_ARRAY: int,
    Parameter.Type.DOUBLE_ARRAY: float,
    Parameter.Type.STRING_ARRAY: str,
}
_VALUE_FIELDS: Final = {kind: f"{kind.name.lower()}_value" for kind in Parameter.Type if kind.value}


def _is_sequence_of(kind: type, value: Any) -> bool:
    if not isinstance(value, list | tuple | array.array):
        return False
    if kind is bytes:
        return all(isinstance(item, bytes) and len(item) == 1 for item in value)
    if kind is int:
        return all(isinstance(item, int) and not isinstance(item, bool) and item in _INT64 for item in value)
    return all(isinstance(item, kind) for item in value)


def get_parameter_value(string_value: str) -> ParameterValue:
    """Return the typed value of a string, parsed as on the command line."""
    value = _yaml.parse_value(string_value)
    try:
        return Parameter("", value=value).get_parameter_value()
    except TypeError:
        return Parameter("", Parameter.Type.STRING, string_value).get_parameter_value()


def parameter_value_to_python(parameter_value: ParameterValue) -> Any:
    """Return the Python value of an `rcl_interfaces/ParameterValue`.

    Raises:
        RuntimeError: The message has an unknown parameter type.
    """
    try:
        kind = Parameter.Type(parameter_value.type)
    except ValueError:
        raise RuntimeError(f"Unexpected parameter type {parameter_value.type}.") from None
    if kind is Parameter.Type.NOT_SET:
        return None
    value = getattr(parameter_value, _VALUE_FIELDS[kind])
    return list(value) if kind in _ITEM_TYPES else value


__all__ = ["PARAMETER_SEPARATOR_STRING", "Parameter", "get_parameter_value", "parameter_value_to_python"]
