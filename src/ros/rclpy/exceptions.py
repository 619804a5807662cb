# SPDX-License-Identifier: Apache-2.0
"""Exceptions raised by rclpy. The exceptions of upstream's native module are defined in `rclpy._rclpy_pybind11`.

Exception
├── NotInitializedException            a context was used before rclpy.init() or after its shutdown
├── NoTypeSupportImportedException     a type is not a ROS message, service or action type
├── NameValidationException            a name is not valid
│   ├── InvalidNamespaceException
│   ├── InvalidNodeNameException
│   ├── InvalidTopicNameException
│   └── InvalidServiceNameException
├── ParameterException
│   ├── ParameterNotDeclaredException
│   ├── ParameterAlreadyDeclaredException
│   ├── InvalidParameterException
│   ├── InvalidParameterValueException
│   ├── InvalidParameterTypeException
│   ├── ParameterImmutableException
│   └── ParameterUninitializedException
└── ROSInterruptException              a shutdown interrupted a sleep

The messages and arguments of the exceptions are upstream's. coframe adds `hint`, which a traceback shows.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from coframe.distributions import since
from rclpy import _absent
from rclpy._rclpy_pybind11 import (
    InvalidHandle,
    NodeNameNonExistentError,
    RCLError,
    RCLInvalidROSArgsError,
    RMWError,
    UnknownROSArgsError,
    UnsupportedEventTypeError,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rclpy.parameter import Parameter

ErrorT = TypeVar("ErrorT", bound=BaseException)

__all__ = [
    "InvalidHandle",
    "InvalidNamespaceException",
    "InvalidNodeNameException",
    "InvalidParameterException",
    "InvalidParameterTypeException",
    "InvalidParameterValueException",
    "InvalidServiceNameException",
    "InvalidTopicNameException",
    "NameValidationException",
    "NoTypeSupportImportedException",
    "NodeNameNonExistentError",
    "NotInitializedException",
    "ParameterAlreadyDeclaredException",
    "ParameterException",
    "ParameterImmutableException",
    "ParameterNotDeclaredException",
    "ParameterUninitializedException",
    "RCLError",
    "RCLInvalidROSArgsError",
    "RMWError",
    "ROSInterruptException",
    "TimerCancelledError",
    "UnknownROSArgsError",
    "UnsupportedEventTypeError",
]


def _with_hint(error: ErrorT, hint: str) -> ErrorT:
    """Return the error with a hint, which a traceback shows below the text (Python 3.11 and later)."""
    error.hint = hint  # type: ignore[attr-defined]
    if hint and hasattr(error, "add_note"):
        error.add_note(f"Hint: {hint}")
    return error


class NotInitializedException(Exception):
    """A context was used before `rclpy.init()` or after its shutdown."""

    def __init__(self, *args: object) -> None:
        text = "rclpy.init() has not been called"
        if since("exception_texts"):
            super().__init__(f"{text}. msg:{args[0]}" if args else f"{text}.")
        else:
            super().__init__(text, *args)


class NoTypeSupportImportedException(Exception):
    """A type is not a ROS message, service or action type."""


class NameValidationException(Exception):
    """A name is not valid.

    Args:
        name_type: Type of the name, for example "topic name".
        name: The invalid name.
        error_msg: The rule that the name violates.
        invalid_index: Index of the offending character.
    """

    def __init__(self, name_type: str, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        text = f"Invalid {name_type}: {error_msg}:\n  '{name}'\n   {' ' * invalid_index}^"
        super().__init__(text, *args)
        self.name_type = name_type
        self.name = name
        self.error_msg = error_msg
        self.invalid_index = invalid_index

    def __str__(self) -> str:
        return str(self.args[0])


class InvalidNamespaceException(NameValidationException):
    """A namespace is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("namespace", name, error_msg, invalid_index, *args)


class InvalidNodeNameException(NameValidationException):
    """A node name is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("node name", name, error_msg, invalid_index, *args)


class InvalidTopicNameException(NameValidationException):
    """A topic name is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("topic name", name, error_msg, invalid_index, *args)


class InvalidServiceNameException(NameValidationException):
    """A service name is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("service name", name, error_msg, invalid_index, *args)


class ParameterException(Exception):
    """Base class of the errors about parameters.

    Args:
        error_msg: Text of the error.
        parameters: Name or names of the parameters.
    """

    def __init__(self, error_msg: str, parameters: str | Sequence[str], *args: object) -> None:
        self.__names = [parameters] if isinstance(parameters, str) else list(parameters)
        if since("exception_texts"):
            super().__init__(f"{error_msg}: {parameters}", *args)
        else:
            super().__init__(error_msg, parameters, *args)

    @property
    def parameters(self) -> list[str]:
        """The names of the parameters."""
        return self.__names


class ParameterNotDeclaredException(ParameterException):
    """An undeclared parameter was used."""

    def __init__(self, parameters: str | Sequence[str], *args: object) -> None:
        super().__init__("Invalid access to undeclared parameter(s)", parameters, *args)


class ParameterAlreadyDeclaredException(ParameterException):
    """A parameter was declared a second time."""

    def __init__(self, parameters: str | Sequence[str], *args: object) -> None:
        super().__init__("Parameter(s) already declared", parameters, *args)


class InvalidParameterException(ParameterException):
    """A parameter name is not valid."""

    def __init__(self, parameter: str, *args: object) -> None:
        super().__init__("Invalid parameter name", parameter, *args)


class InvalidParameterValueException(ParameterException):
    """A value was rejected by the parameter's range or by a callback.

    Args:
        parameter: Name of the parameter.
        value: The rejected value.
        reason: The reason for the rejection.
    """

    def __init__(self, parameter: str, value: object, reason: str = "", *args: object) -> None:
        super().__init__(f"Invalid parameter value ({value}) for parameter. Reason: {reason}", parameter, *args)
        self.value = value
        self.reason = reason


class InvalidParameterTypeException(ParameterException):
    """The type of a value differs from the declared type of the parameter.

    Args:
        desired_parameter: The parameter with the value that was to be set.
        expected_type: Name of the declared type.
    """

    def __init__(self, desired_parameter: Parameter[Any], expected_type: str, *args: object) -> None:
        text = (
            f"Trying to set parameter '{desired_parameter.name}' to '{desired_parameter.value}' of type "
            f"'{desired_parameter.type_.name}', expecting type '{expected_type}'"
        )
        super().__init__(text, desired_parameter.name, *args)
        if not since("exception_texts"):
            self.args = (text, *args)


class ParameterImmutableException(ParameterException):
    """A change of a read-only parameter was attempted."""

    def __init__(self, parameter: str, *args: object) -> None:
        super().__init__("Attempted to modify read-only parameter", parameter, *args)


class ParameterUninitializedException(ParameterException):
    """A parameter that was declared with only a type has no value yet."""

    def __init__(self, parameter_name: str, *args: object) -> None:
        text = f"The parameter '{parameter_name}' is not initialized"
        super().__init__(text, parameter_name, *args)
        if not since("exception_texts"):
            self.args = (text, *args)


class TimerCancelledError(Exception):
    """A timer that was cancelled is called."""


class ROSInterruptException(Exception):
    """A shutdown interrupted a sleep."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.shutdown() has been called", *args)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
