"""What rclpy raises.

Exception
├── NotInitializedException            a context is used before rclpy.init() or after its shutdown
├── NoTypeSupportImportedException     something that is no ROS message type was given as one
├── RCLError                           the ROS client library could not do what was asked (a RuntimeError)
│   └── RCLInvalidROSArgsError         arguments after --ros-args are malformed
│       └── UnknownROSArgsError        ... or not known
├── InvalidHandle                      a destroyed node, publisher, ... is used
├── NameValidationException            a name breaks the rules; shows where
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
└── ROSInterruptException              a sleep was cut short by the shutdown
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rclpy.parameter import Parameter


class NotInitializedException(Exception):
    """A context is used before `rclpy.init()` or after its shutdown."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.init() has not been called", *args)


class NoTypeSupportImportedException(Exception):
    """Something that is no ROS message or service type was given as one."""


class RCLError(RuntimeError):
    """The ROS client library could not do what was asked."""


class RCLInvalidROSArgsError(RCLError):
    """Arguments after `--ros-args` are malformed."""


class UnknownROSArgsError(RCLInvalidROSArgsError):
    """Arguments after `--ros-args` are not known."""


class InvalidHandle(Exception):
    """A destroyed node, publisher, subscription, ... is used."""


class NameValidationException(Exception):
    """A name breaks ROS's rules.

    Args:
        name_type: What the name is for, for example "topic name".
        name: The name.
        error_msg: The rule it breaks.
        invalid_index: Position of the offending character.
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
    """A namespace breaks ROS's rules."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("namespace", name, error_msg, invalid_index, *args)


class InvalidNodeNameException(NameValidationException):
    """A node name breaks ROS's rules."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("node name", name, error_msg, invalid_index, *args)


class InvalidTopicNameException(NameValidationException):
    """A topic name breaks ROS's rules."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("topic name", name, error_msg, invalid_index, *args)


class InvalidServiceNameException(NameValidationException):
    """A service name breaks ROS's rules."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("service name", name, error_msg, invalid_index, *args)


class ParameterException(Exception):
    """Base of all that is wrong with a parameter.

    Args:
        error_msg: The text.
        parameters: Names of the parameters concerned.
    """

    def __init__(self, error_msg: str, parameters: str | Iterable[str], *args: object) -> None:
        names = [parameters] if isinstance(parameters, str) else list(parameters)
        super().__init__(f"{error_msg}: {names}", *args)
        self.parameters = names


class ParameterNotDeclaredException(ParameterException):
    """A parameter is used that nobody has declared."""

    def __init__(self, parameters: str | Iterable[str], *args: object) -> None:
        super().__init__("Invalid access to undeclared parameter(s)", parameters, *args)


class ParameterAlreadyDeclaredException(ParameterException):
    """A parameter is declared a second time."""

    def __init__(self, parameters: str | Iterable[str], *args: object) -> None:
        super().__init__("Parameter(s) already declared", parameters, *args)


class InvalidParameterException(ParameterException):
    """A parameter name breaks the rules."""

    def __init__(self, parameter: str, *args: object) -> None:
        super().__init__("Invalid parameter name", parameter, *args)


class InvalidParameterValueException(ParameterException):
    """A value is refused by the parameter's range or by a callback.

    Args:
        parameter: Name of the parameter.
        value: The refused value.
        reason: Why.
    """

    def __init__(self, parameter: str, value: object, reason: str = "", *args: object) -> None:
        super().__init__("Invalid parameter value", parameter, *args)
        self.value = value
        self.reason = reason

    def __str__(self) -> str:
        return f"Invalid parameter value ({self.value}) for parameter '{self.parameters[0]}'. Reason: {self.reason}"


class InvalidParameterTypeException(InvalidParameterValueException):
    """A value has another type than the parameter was declared with.

    Args:
        desired_parameter: The parameter as somebody tries to set it.
        expected_type: Name of the declared type.
    """

    def __init__(self, desired_parameter: Parameter[Any], expected_type: str, *args: object) -> None:
        reason = (
            f"Trying to set parameter '{desired_parameter.name}' to '{desired_parameter.value}' of type "
            f"'{desired_parameter.type_.name}', expecting type '{expected_type}'"
        )
        super().__init__(desired_parameter.name, desired_parameter.value, reason, *args)


class ParameterImmutableException(ParameterException):
    """A read-only parameter is to be changed."""

    def __init__(self, parameter: str, *args: object) -> None:
        super().__init__("Attempted to modify read-only parameter", parameter, *args)


class ParameterUninitializedException(ParameterException):
    """A parameter was declared by type only and has no value yet."""

    def __init__(self, parameter: str, *args: object) -> None:
        super().__init__("The parameter is not initialized", parameter, *args)


class ROSInterruptException(Exception):
    """A sleep was cut short by the shutdown."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.shutdown() has been called", *args)
