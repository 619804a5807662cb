# SPDX-License-Identifier: Apache-2.0
"""Parameters, which have a name and a value of one of nine types."""

from __future__ import annotations

import array
from enum import Enum, IntEnum
from functools import partial
from typing import Any, Final, Generic, TypeVar

import coframe.lazy_numpy as np
from coframe._files.os_errors import reason
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterType, ParameterValue
from rclpy import _absent, _yaml
from rclpy._numbers import to_python
from rclpy.exceptions import _with_hint

T = TypeVar("T")

PARAMETER_SEPARATOR_STRING: Final = "."
# A comparison, because `in range(...)` searches the whole range for an IntEnum.
_MIN_INT64: Final = -(2**63)
_MAX_INT64: Final = 2**63 - 1


class Parameter(Generic[T]):
    """A parameter with a typed value.

    Args:
        name: Name of the parameter.
        type_: Type of the parameter. None: the type of the value.
        value: Value of the parameter. NumPy's numbers and booleans are converted to Python's.

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

        # Upstream's types are not numbers, so that texts contain their names.
        __str__ = Enum.__str__
        __format__ = Enum.__format__

        @classmethod
        def from_parameter_value(cls, parameter_value: Any) -> Parameter.Type:
            """Return the parameter type of a Python value. An empty list is a byte array, as in upstream rclpy.

            Raises:
                TypeError: The value is not of a parameter type.
            """
            value = _to_python(parameter_value)
            for kind in cls:
                if kind.check(value):
                    return kind
            is_list = isinstance(parameter_value, list | tuple | array.array)
            error = TypeError(
                f"The given value is not {'a list of ' * is_list}one of the allowed types '{parameter_value}'."
            )
            hint = "Use a bool, int, float or str, or a list of one of these types or of bytes of length 1."
            if np.is_array(parameter_value):
                hint = "Convert the NumPy array with its method tolist()."
            raise _with_hint(error, hint)

        def check(self, parameter_value: Any) -> bool:
            """Return whether a Python value has this parameter type."""
            value = _to_python(parameter_value)
            if self is Parameter.Type.NOT_SET:
                return value is None
            if self in _ITEM_TYPES:
                return _is_sequence_of(_ITEM_TYPES[self], value)
            if self is Parameter.Type.INTEGER:
                return _is_integer(value)
            return isinstance(value, _SCALAR_TYPES[self])

    def __init__(self, name: str, type_: Parameter.Type | None = None, value: T | None = None) -> None:
        converted = _to_python(value)
        if type_ is None:
            type_ = Parameter.Type.from_parameter_value(converted)
        if not isinstance(type_, Parameter.Type):
            raise TypeError(f"type must be an instance of '{Parameter.Type!r}'")
        if not type_.check(converted):
            raise ValueError(f"Type '{type_}' and value '{value}' do not agree")
        self._name = name
        self._type_ = type_
        self._value = converted

    @classmethod
    def from_parameter_msg(cls, param_msg: ParameterMsg) -> Parameter[Any]:
        """Create a parameter from an `rcl_interfaces/Parameter`."""
        kind = _type_of(param_msg.value)
        return cls(
            param_msg.name, kind, getattr(param_msg.value, _VALUE_FIELDS[kind]) if kind in _VALUE_FIELDS else None
        )

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
        message = ParameterValue(type=self.type_.value)
        if (field := _VALUE_FIELDS.get(self.type_)) is not None:
            setattr(message, field, self.value)
        return message

    def to_parameter_msg(self) -> ParameterMsg:
        """Return the parameter as an `rcl_interfaces/Parameter`."""
        return ParameterMsg(name=self.name, value=self.get_parameter_value())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Parameter):
            return NotImplemented
        return self.to_parameter_msg() == other.to_parameter_msg()

    def __hash__(self) -> int:
        return hash((self.name, self.type_))

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
_PYTHON_TYPES: Final = frozenset({bool, int, float, str, bytes, type(None)})
_VALUE_FIELDS: Final = {kind: f"{kind.name.lower()}_value" for kind in Parameter.Type if kind.value}


def _is_sequence_of(kind: type, value: Any) -> bool:
    if not isinstance(value, list | tuple | array.array):
        return False
    if kind is bytes:
        return all(isinstance(item, bytes) and len(item) == 1 for item in value)
    if kind is int:
        return all(map(_is_integer, value))
    return all(isinstance(item, kind) for item in value)


def _is_integer(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and _MIN_INT64 <= value <= _MAX_INT64


def _to_python(value: Any) -> Any:
    """Convert NumPy's numbers and booleans, also inside lists, to Python's; return any other value unchanged."""
    if type(value) in _PYTHON_TYPES:  # The usual case, and much faster.
        return value
    if isinstance(value, list | tuple):
        others = {*map(type, value)} - _PYTHON_TYPES
        if others and any(issubclass(kind, np.generic) for kind in others):
            return [to_python(item) for item in value]
    return to_python(value)


def get_parameter_value(string_value: str) -> ParameterValue:
    """Return the typed value of a string, parsed as on the command line."""
    try:
        return Parameter("", value=_yaml.parse_value(string_value)).get_parameter_value()
    except (TypeError, ValueError):
        return Parameter("", Parameter.Type.STRING, string_value).get_parameter_value()


def parameter_value_to_python(parameter_value: ParameterValue) -> Any:
    """Return the Python value of an `rcl_interfaces/ParameterValue`.

    Raises:
        RuntimeError: The message has an unknown parameter type.
    """
    kind = _type_of(parameter_value)
    if kind is Parameter.Type.NOT_SET:
        return None
    value = getattr(parameter_value, _VALUE_FIELDS[kind])
    return list(value) if kind in _ITEM_TYPES else value


def parameter_dict_from_yaml_file(
    parameter_file: str,
    use_wildcard: bool = False,
    target_nodes: list[str] | None = None,
    namespace: str = "",
) -> dict[str, ParameterMsg]:
    """Return the parameters of a YAML file as messages, by their names.

    Args:
        parameter_file: Path of the file, which has the format of `--params-file`.
        use_wildcard: Whether to include the parameters below `/**` and other patterns. Those of nodes override them.
        target_nodes: Fully qualified names of the nodes whose parameters are read. None for all nodes of the file.
        namespace: Prefix of the returned names, without the dot.

    Raises:
        RuntimeError: The file does not exist, is not a parameter file, or has no parameters of the nodes.
    """
    try:
        nodes = _yaml.load_parameters(parameter_file)
    except (OSError, ValueError) as error:
        raise RuntimeError(f"cannot read the parameters of {parameter_file}: {reason(error)}") from error
    wildcards = [pattern for pattern in nodes if "*" in pattern]
    named = [pattern for pattern in nodes if "*" not in pattern]
    if target_nodes:
        wildcards = [each for each in wildcards if any(_yaml.is_match(each, node) for node in target_nodes)]
        named = [each for each in named if any(_yaml.is_match(each, node) for node in target_nodes)]
    found: dict[str, ParameterMsg] = {}
    for pattern in [*(wildcards if use_wildcard else ()), *named]:
        for name, value in nodes[pattern].items():
            full = f"{namespace}{PARAMETER_SEPARATOR_STRING}{name}" if namespace else name
            found[full] = Parameter(full, value=value).to_parameter_msg()
    if not found:
        wanted = ", ".join(target_nodes or ["any node"])
        raise RuntimeError(
            f"Param file does not contain any valid parameters for {wanted}. It contains parameters for: {list(nodes)}"
        )
    return found


def _type_of(parameter_value: ParameterValue) -> Parameter.Type:
    try:
        return Parameter.Type(parameter_value.type)
    except ValueError:
        raise RuntimeError(f"Unexpected parameter type {parameter_value.type}.") from None


__all__ = [
    "PARAMETER_SEPARATOR_STRING",
    "Parameter",
    "ParameterMsg",
    "ParameterType",
    "ParameterValue",
    "get_parameter_value",
    "parameter_dict_from_yaml_file",
    "parameter_value_to_python",
]

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
