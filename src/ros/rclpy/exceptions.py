# SPDX-License-Identifier: Apache-2.0
"""Exceptions raised by rclpy.

Exception
├── NotInitializedException            a context was used before rclpy.init() or after its shutdown
├── NoTypeSupportImportedException     a type is not a ROS message, service or action type
├── RCLError                           an operation of the ROS client library failed (a RuntimeError)
│   └── RCLInvalidROSArgsError         arguments after --ros-args are malformed
│       └── UnknownROSArgsError        arguments after --ros-args are unknown
├── InvalidHandle                      a destroyed node, publisher or other entity was used
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
│   │   └── InvalidParameterTypeException
│   ├── ParameterImmutableException
│   └── ParameterUninitializedException
└── ROSInterruptException              a shutdown interrupted a sleep
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rclpy.parameter import Parameter


class NotInitializedException(Exception):
    """A context was used before `rclpy.init()` or after its shutdown."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.init() has not been called", *args)


class NoTypeSupportImportedException(Exception):
    """A type is not a ROS message, service or action type."""


class RCLError(RuntimeError):
    """An operation of the ROS client library failed."""


class RCLInvalidROSArgsError(RCLError):
    """Arguments after `--ros-args` are malformed."""


class UnknownROSArgsError(RCLInvalidROSArgsError):
    """Arguments after `--ros-args` are unknown."""


class InvalidHandle(Exception):
    """A destroyed node, publisher, subscription or other entity was used."""


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

    def __init__(self, error_msg: str, parameters: str | Iterable[str], *args: object) -> None:
        names = [parameters] if isinstance(parameters, str) else list(parameters)
        super().__init__(f"{error_msg}: {names}", *args)
        self.parameters = names


class ParameterNotDeclaredException(ParameterException):
    """An undeclared parameter was used."""

    def __init__(self, parameters: str | Iterable[str], *args: object) -> None:
        super().__init__("Invalid access to undeclared parameter(s)", parameters, *args)


class ParameterAlreadyDeclaredException(ParameterException):
    """A parameter was declared a second time."""

    def __init__(self, parameters: str | Iterable[str], *args: object) -> None:
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
        super().__init__("Invalid parameter value", parameter, *args)
        self.value = value
        self.reason = reason

    def __str__(self) -> str:
        return f"Invalid parameter value ({self.value}) for parameter '{self.parameters[0]}'. Reason: {self.reason}"


class InvalidParameterTypeException(InvalidParameterValueException):
    """The type of a value differs from the declared type of the parameter.

    Args:
        desired_parameter: The parameter with the value that was to be set.
        expected_type: Name of the declared type.
    """

    def __init__(self, desired_parameter: Parameter[Any], expected_type: str, *args: object) -> None:
        reason = (
            f"Trying to set parameter '{desired_parameter.name}' to '{desired_parameter.value}' of type "
            f"'{desired_parameter.type_.name}', expecting type '{expected_type}'"
        )
        super().__init__(desired_parameter.name, desired_parameter.value, reason, *args)


class ParameterImmutableException(ParameterException):
    """A change of a read-only parameter was attempted."""

    def __init__(self, parameter: str, *args: object) -> None:
        super().__init__("Attempted to modify read-only parameter", parameter, *args)


class ParameterUninitializedException(ParameterException):
    """A parameter that was declared with only a type has no value yet."""

    def __init__(self, parameter: str, *args: object) -> None:
        super().__init__("The parameter is not initialized", parameter, *args)


class ROSInterruptException(Exception):
    """A shutdown interrupted a sleep."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.shutdown() has been called", *args)
