# SPDX-License-Identifier: Apache-2.0
"""Parameters of nodes."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Any, Final

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, Parameter, parameter_value_to_python
from rclpy.validate_parameter_name import validate_parameter_name

SetCallback = Callable[[list["Parameter[Any]"]], SetParametersResult]
_DEFAULT_STEP_TOLERANCE: Final = 1e-9


class NodeParameters:
    """Base class of `Node` with its parameters.

    Args:
        overrides: Values from the command line and the constructor, which override the declared defaults.
        allow_undeclared: Whether undeclared parameters may be used.
        declare_overrides: Whether to declare all overrides.
    """

    def __init__(
        self, overrides: dict[str, Parameter[Any]], *, allow_undeclared: bool, declare_overrides: bool
    ) -> None:
        self.__lock = threading.RLock()
        self.__parameters: dict[str, Parameter[Any]] = {}
        self.__descriptors: dict[str, ParameterDescriptor] = {}
        self.__callbacks: list[SetCallback] = []
        self.__overrides = overrides
        self.__allow_undeclared = allow_undeclared
        if declare_overrides:
            for name, parameter in overrides.items():
                self.declare_parameter(name, parameter.value, ParameterDescriptor(dynamic_typing=True))

    def declare_parameter(
        self,
        name: str,
        value: Any = None,
        descriptor: ParameterDescriptor | None = None,
        ignore_override: bool = False,
    ) -> Parameter[Any]:
        """Declare a parameter.

        Args:
            name: Name of the parameter.
            value: Default value, or a Parameter.Type if there is no default. None: a dynamically typed parameter.
            descriptor: Description, range, and whether the parameter is read-only or dynamically typed.
            ignore_override: Whether to use the default even if there is an override.

        Returns:
            The parameter with its current value.

        Raises:
            ParameterAlreadyDeclaredException: The parameter was declared before.
            InvalidParameterException: The name is empty.
            InvalidParameterTypeException: The types of the override and the default differ.
            InvalidParameterValueException: The value is out of range, or a callback rejected it.
        """
        validate_parameter_name(name)
        if descriptor is None:
            descriptor = ParameterDescriptor(dynamic_typing=value is None)
        with self.__lock:
            if self.has_parameter(name):
                raise ParameterAlreadyDeclaredException(name)
            parameter, expected = self.__initial(name, value, ignore_override=ignore_override)
            if not descriptor.dynamic_typing:
                if expected is Parameter.Type.NOT_SET:
                    raise ValueError(f"Cannot declare parameter {name} as statically typed of type NOT_SET")
                if parameter.type_ not in {expected, Parameter.Type.NOT_SET}:
                    raise InvalidParameterTypeException(parameter, expected.name)
            descriptor.name = name
            descriptor.type = int(parameter.type_ if descriptor.dynamic_typing else expected)
            self.__descriptors[name] = descriptor
            result = self.__apply([parameter], is_declaration=True)
            if not result.successful:
                del self.__descriptors[name]
                raise InvalidParameterValueException(name, parameter.value, result.reason)
            return self.__parameters[name]

    def declare_parameters(
        self,
        namespace: str,
        parameters: Sequence[tuple[Any, ...]],
        ignore_override: bool = False,
    ) -> list[Parameter[Any]]:
        """Declare several parameters.

        Args:
            namespace: Prefix of the names without the dot, which may be empty.
            parameters: Tuples (name), (name, value) or (name, value, descriptor).
            ignore_override: Whether to use the defaults even if there are overrides.

        Raises:
            TypeError: A tuple has another form.
            Exception: Any exception of `declare_parameter`.
        """
        declared = []
        for item in parameters:
            if not 1 <= len(item) <= 3 or not isinstance(item[0], str):
                raise TypeError(
                    f"Invalid parameter tuple {item}. Expected (name), (name, value) or (name, value, descriptor)."
                )
            name = f"{namespace}{PARAMETER_SEPARATOR_STRING}{item[0]}" if namespace else item[0]
            value, descriptor = (*item[1:], None, None)[:2]
            declared.append(self.declare_parameter(name, value, descriptor, ignore_override))
        return declared

    def undeclare_parameter(self, name: str) -> None:
        """Undeclare a parameter.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared.
            ParameterImmutableException: The parameter is read-only.
        """
        with self.__lock:
            if not self.has_parameter(name):
                raise ParameterNotDeclaredException(name)
            if self.__descriptors[name].read_only:
                raise ParameterImmutableException(name)
            del self.__parameters[name]
            del self.__descriptors[name]

    def has_parameter(self, name: str) -> bool:
        """Return whether a parameter is declared."""
        return name in self.__parameters

    def get_parameter(self, name: str) -> Parameter[Any]:
        """Return a parameter.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared, and undeclared parameters are not allowed.
            ParameterUninitializedException: The parameter was declared with only a type and has no value yet.
        """
        with self.__lock:
            parameter = self.__parameters.get(name)
            if parameter is None:
                if self.__allow_undeclared:
                    return Parameter(name)
                raise ParameterNotDeclaredException(name)
            if parameter.type_ is Parameter.Type.NOT_SET and not self.__descriptors[name].dynamic_typing:
                raise ParameterUninitializedException(name)
            return parameter

    def get_parameters(self, names: list[str]) -> list[Parameter[Any]]:
        """Return several parameters; see `get_parameter`."""
        return [self.get_parameter(name) for name in names]

    def get_parameter_or(self, name: str, alternative_value: Parameter[Any] | None = None) -> Parameter[Any]:
        """Return a parameter, or the alternative if it has no value. None as the alternative: an unset parameter."""
        parameter = self.__parameters.get(name)
        if parameter is not None and parameter.type_ is not Parameter.Type.NOT_SET:
            return parameter
        return Parameter(name) if alternative_value is None else alternative_value

    def get_parameter_type(self, name: str) -> Parameter.Type:
        """Return the type of a parameter.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared, and undeclared parameters are not allowed.
        """
        parameter = self.__parameters.get(name)
        if parameter is None and not self.__allow_undeclared:
            raise ParameterNotDeclaredException(name)
        return Parameter.Type.NOT_SET if parameter is None else parameter.type_

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter[Any]]:
        """Return all parameters with a prefix, by their names without the prefix."""
        if prefix and not prefix.endswith(PARAMETER_SEPARATOR_STRING):
            prefix += PARAMETER_SEPARATOR_STRING
        with self.__lock:
            return {
                name[len(prefix) :]: parameter
                for name, parameter in self.__parameters.items()
                if name.startswith(prefix)
            }

    def set_parameters(self, parameter_list: list[Parameter[Any]]) -> list[SetParametersResult]:
        """Set parameters one after another.

        Returns:
            For each parameter whether it was set, and the reason if it was not.

        Raises:
            ParameterNotDeclaredException: A parameter is not declared, and undeclared parameters are not allowed.
        """
        with self.__lock:
            self.__check_declared(parameter_list)
            return [self.__apply([parameter]) for parameter in parameter_list]

    def set_parameters_atomically(self, parameter_list: list[Parameter[Any]]) -> SetParametersResult:
        """Set all parameters, or no parameter if one is rejected.

        Raises:
            ParameterNotDeclaredException: A parameter is not declared, and undeclared parameters are not allowed.
        """
        with self.__lock:
            self.__check_declared(parameter_list)
            return self.__apply(parameter_list)

    def add_on_set_parameters_callback(self, callback: SetCallback) -> None:
        """Add a callback that receives a list of parameters before they are set and returns a SetParametersResult."""
        self.__callbacks.insert(0, callback)

    def remove_on_set_parameters_callback(self, callback: SetCallback) -> None:
        """Remove a callback.

        Raises:
            ValueError: The callback was not added.
        """
        self.__callbacks.remove(callback)

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """Return the descriptor of a parameter.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared, and undeclared parameters are not allowed.
        """
        descriptor = self.__descriptors.get(name)
        if descriptor is None:
            if self.__allow_undeclared:
                return ParameterDescriptor(name=name)
            raise ParameterNotDeclaredException(name)
        return descriptor

    def describe_parameters(self, names: list[str]) -> list[ParameterDescriptor]:
        """Return the descriptors of several parameters; see `describe_parameter`."""
        return [self.describe_parameter(name) for name in names]

    def set_descriptor(self, name: str, descriptor: ParameterDescriptor, alternative_value: Any = None) -> Any:
        """Replace the descriptor of a parameter.

        Args:
            name: Name of the parameter.
            descriptor: The new descriptor. The type of the parameter does not change.
            alternative_value: A ParameterValue that is set if the current value is out of the new range.

        Returns:
            The value of the parameter as a ParameterValue.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared.
            ParameterImmutableException: The parameter is read-only.
            InvalidParameterValueException: Both values are out of range.
        """
        with self.__lock:
            if not self.has_parameter(name):
                raise ParameterNotDeclaredException(name)
            before = self.__descriptors[name]
            if before.read_only:
                raise ParameterImmutableException(name)
            descriptor.name, descriptor.type = name, before.type
            parameter = self.__parameters[name]
            if alternative_value is not None and _range_fault(parameter, descriptor):
                parameter = Parameter(name, value=parameter_value_to_python(alternative_value))
            if fault := _range_fault(parameter, descriptor):
                raise InvalidParameterValueException(name, parameter.value, fault)
            self.__descriptors[name] = descriptor
            self.__parameters[name] = parameter
            return parameter.get_parameter_value()

    def __initial(self, name: str, value: Any, *, ignore_override: bool) -> tuple[Parameter[Any], Parameter.Type]:
        """Return the parameter with its initial value, and its declared type."""
        if isinstance(value, Parameter.Type):
            default, expected = Parameter[Any](name), value
        else:
            default = Parameter(name, value=value)
            expected = default.type_
        if ignore_override or name not in self.__overrides:
            return default, expected
        return Parameter(name, value=self.__overrides[name].value), expected

    def __check_declared(self, parameters: list[Parameter[Any]]) -> None:
        for parameter in parameters:
            if not isinstance(parameter, Parameter):
                raise TypeError(f"parameter must be instance of type '{Parameter!r}', got {parameter!r}")
        unknown = [parameter.name for parameter in parameters if not self.has_parameter(parameter.name)]
        if unknown and not self.__allow_undeclared:
            raise ParameterNotDeclaredException(unknown)

    def __apply(self, parameters: list[Parameter[Any]], *, is_declaration: bool = False) -> SetParametersResult:
        for parameter in parameters:
            descriptor = self.__descriptors.get(parameter.name)
            if descriptor is None:
                continue
            fault = _range_fault(parameter, descriptor)
            if not is_declaration:
                fault = _change_fault(parameter, descriptor) or fault
            if fault:
                return SetParametersResult(successful=False, reason=fault)
        for callback in list(self.__callbacks):
            result = callback(parameters)
            if not result.successful:
                return result
        for parameter in parameters:
            self.__store(parameter, is_declaration=is_declaration)
        return SetParametersResult(successful=True)

    def __store(self, parameter: Parameter[Any], *, is_declaration: bool) -> None:
        if parameter.type_ is Parameter.Type.NOT_SET and not is_declaration:
            self.__parameters.pop(parameter.name, None)
            self.__descriptors.pop(parameter.name, None)
            return
        descriptor = self.__descriptors.setdefault(
            parameter.name, ParameterDescriptor(name=parameter.name, dynamic_typing=True)
        )
        if descriptor.dynamic_typing:
            descriptor.type = int(parameter.type_)
        self.__parameters[parameter.name] = parameter
        self._Coframe__on_parameter_set(parameter)

    def _Coframe__on_parameter_set(self, parameter: Parameter[Any]) -> None:
        """Handle a new value of a parameter. Subclasses override this."""


def _change_fault(parameter: Parameter[Any], descriptor: ParameterDescriptor) -> str:
    """Return why a declared parameter must not be changed to this value, or an empty string if it may."""
    if descriptor.read_only:
        return f"Trying to set a read-only parameter: {parameter.name}."
    if not descriptor.dynamic_typing and parameter.type_ != descriptor.type:
        expected = Parameter.Type(descriptor.type).name
        return f"Wrong parameter type, expected '{expected}' got '{parameter.type_.name}'"
    return ""


def _range_fault(parameter: Parameter[Any], descriptor: ParameterDescriptor) -> str:
    """Return why a value is out of the range of the descriptor, or an empty string if it is in range."""
    ranges: list[Any]
    if parameter.type_ is Parameter.Type.INTEGER:
        ranges, tolerance = list(descriptor.integer_range), 0.0
    elif parameter.type_ is Parameter.Type.DOUBLE:
        ranges, tolerance = list(descriptor.floating_point_range), _DEFAULT_STEP_TOLERANCE
    else:
        return ""
    value = parameter.value
    for limits in ranges:
        low, high, step = limits.from_value, limits.to_value, limits.step
        if not low - tolerance <= value <= high + tolerance:
            return f"Parameter {parameter.name} out of range. Min: {low}, Max: {high}, value: {value}"
        steps = (value - low) / step if step else 0.0
        is_end = abs(value - high) <= tolerance
        if step and not is_end and abs(steps - round(steps)) > tolerance:
            return f"The parameter value for {parameter.name} must be a multiple of the step {step} from {low}"
    return ""
