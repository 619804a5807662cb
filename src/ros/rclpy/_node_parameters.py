# SPDX-License-Identifier: Apache-2.0
"""Parameters of nodes."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Callable, Sequence
from collections.abc import Set as AbstractSet
from typing import Any, Final

from coframe._output.formatting import did_you_mean
from rcl_interfaces.msg import (
    ListParametersResult,
    ParameterDescriptor,
    ParameterEvent,
    ParameterValue,
    SetParametersResult,
)
from rclpy._parameter_ranges import (
    RELATIVE_TOLERANCE,
    change_fault,
    is_array_type,
    is_empty,
    range_fault,
    with_type,
)
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
    _with_hint,
)
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, Parameter, parameter_value_to_python
from rclpy.validate_parameter_name import validate_parameter_name

PreSetCallback = Callable[[list["Parameter[Any]"]], list["Parameter[Any]"]]
SetCallback = Callable[[list["Parameter[Any]"]], SetParametersResult]
PostSetCallback = Callable[[list["Parameter[Any]"]], None]

_NOT_SET: Final = Parameter.Type.NOT_SET


class _ParametersByName:
    """Attribute `_parameters` of nodes: on Humble, which has no `list_parameters`, programs read it.

    A node can have an attribute of its own with this name, because this class has no `__set__`.
    """

    def __get__(self, node: NodeParameters | None, _: type[NodeParameters]) -> Any:
        if node is None:
            return self
        return {name: node.get_parameter(name) for name in node.list_parameters([], 0).names}


class NodeParameters:
    """Base class of `Node` with its parameters.

    Args:
        overrides: Values from the command line and the constructor, which override the declared defaults.
        allow_undeclared: Whether undeclared parameters may be used.
        declare_overrides: Whether to declare all overrides.

    Attributes:
        PARAM_REL_TOL: Relative tolerance of the ends and steps of floating-point ranges.
    """

    PARAM_REL_TOL = RELATIVE_TOLERANCE
    _parameters = _ParametersByName()

    def __init__(
        self, overrides: dict[str, Parameter[Any]], *, allow_undeclared: bool, declare_overrides: bool
    ) -> None:
        self.__lock = threading.RLock()
        self.__parameters: dict[str, Parameter[Any]] = {}
        self.__descriptors: dict[str, ParameterDescriptor] = {}
        self.__without_element_type: set[str] = set()  # declared with an empty list
        self.__pre_set_callbacks: list[PreSetCallback] = []
        self.__callbacks: list[SetCallback] = []
        self.__post_set_callbacks: list[PostSetCallback] = []
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
            value: Default value, which may be a ParameterValue, or a Parameter.Type if there is no default. None: a
                dynamically typed parameter. An empty list has the array type of the descriptor, of the override, or of
                the first list that is set.
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
        if isinstance(value, ParameterValue):
            value = parameter_value_to_python(value)
        if descriptor is None:
            if value is None:
                _warn_of_missing_default(name)
            descriptor = ParameterDescriptor(dynamic_typing=value is None)
        with self.__lock:
            if self.has_parameter(name):
                raise ParameterAlreadyDeclaredException([name])
            parameter, expected = self.__initial(name, value, descriptor.type, ignore_override=ignore_override)
            if not descriptor.dynamic_typing:
                parameter = with_type(parameter, expected)
                if expected is Parameter.Type.NOT_SET:
                    raise ValueError(f"Cannot declare parameter {name} as statically typed of type NOT_SET")
                if parameter.type_ not in {expected, Parameter.Type.NOT_SET}:
                    raise InvalidParameterTypeException(parameter, expected.name)
            descriptor.name = name
            descriptor.type = (parameter.type_ if descriptor.dynamic_typing else expected).value
            self.__descriptors[name] = descriptor
            result = self.__apply([parameter], is_declaration=True)
            if not result.successful:
                del self.__descriptors[name]
                raise InvalidParameterValueException(name, parameter.value, result.reason)
            if not descriptor.dynamic_typing and expected is Parameter.Type.BYTE_ARRAY and is_empty(parameter):
                self.__without_element_type.add(name)
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
                raise self.__not_declared(name)
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
        parameter = self.__parameters.get(name)
        if parameter is not None and parameter.type_ is not _NOT_SET:
            return parameter  # The usual case, without the lock.
        with self.__lock:
            parameter = self.__parameters.get(name)
            if parameter is None:
                if self.__allow_undeclared:
                    return Parameter(name)
                raise self.__not_declared(name)
            if parameter.type_ is Parameter.Type.NOT_SET and not self.__descriptors[name].dynamic_typing:
                raise ParameterUninitializedException(name)
            return parameter

    def get_parameters(self, names: list[str]) -> list[Parameter[Any]]:
        """Return several parameters. See `get_parameter`."""
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
            raise self.__not_declared(name)
        # As in ROS 2, a number, although the annotation says otherwise.
        return Parameter.Type.NOT_SET if parameter is None else parameter.type_.value  # type: ignore[return-value]

    def get_parameter_types(self, names: list[str]) -> list[Parameter.Type]:
        """Return the types of several parameters. See `get_parameter_type`."""
        return [self.get_parameter_type(name) for name in names]

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

    def list_parameters(self, prefixes: list[str], depth: int = 0) -> ListParametersResult:
        """Return the names of the declared parameters, and their prefixes.

        Args:
            prefixes: Prefixes of the names, without the last dot. An empty list: all parameters.
            depth: Number of levels below a prefix that are included. 0: all levels.
        """
        wanted = frozenset(prefixes)
        with self.__lock:
            names = [name for name in self.__parameters if _is_listed(name, wanted, depth)]
        found = {name.rpartition(PARAMETER_SEPARATOR_STRING)[0] for name in names} - {""}
        return ListParametersResult(names=names, prefixes=sorted(found))

    def set_parameters(self, parameter_list: list[Parameter[Any]]) -> list[SetParametersResult]:
        """Set parameters one after another.

        Returns:
            For each parameter whether it was set, and the reason if it was not.

        Raises:
            ParameterNotDeclaredException: A parameter is not declared, and undeclared parameters are not allowed. The
                parameters before it were set.
        """
        results = []
        with self.__lock:
            for parameter in parameter_list:
                self.__check_declared([parameter])
                results.append(self.__set([parameter]))
        return results

    def set_parameters_atomically(self, parameter_list: list[Parameter[Any]]) -> SetParametersResult:
        """Set all parameters, or no parameter if one is rejected.

        Raises:
            ParameterNotDeclaredException: A parameter is not declared, and undeclared parameters are not allowed.
        """
        with self.__lock:
            self.__check_declared(parameter_list)
            return self.__set(parameter_list)

    def add_on_set_parameters_callback(self, callback: SetCallback) -> None:
        """Add a callback that receives a list of parameters before they are set and returns a SetParametersResult."""
        self.__callbacks.insert(0, callback)

    def remove_on_set_parameters_callback(self, callback: SetCallback) -> None:
        """Remove a callback.

        Raises:
            ValueError: The callback was not added.
        """
        self.__callbacks.remove(callback)

    def add_pre_set_parameters_callback(self, callback: PreSetCallback) -> None:
        """Add a callback that receives the parameters to set and returns those to set instead."""
        self.__pre_set_callbacks.insert(0, callback)

    def remove_pre_set_parameters_callback(self, callback: PreSetCallback) -> None:
        """Remove a callback.

        Raises:
            ValueError: The callback was not added.
        """
        self.__pre_set_callbacks.remove(callback)

    def add_post_set_parameters_callback(self, callback: PostSetCallback) -> None:
        """Add a callback that receives the parameters that were set."""
        self.__post_set_callbacks.insert(0, callback)

    def remove_post_set_parameters_callback(self, callback: PostSetCallback) -> None:
        """Remove a callback.

        Raises:
            ValueError: The callback was not added.
        """
        self.__post_set_callbacks.remove(callback)

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """Return the descriptor of a parameter.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared, and undeclared parameters are not allowed.
        """
        descriptor = self.__descriptors.get(name)
        if descriptor is None:
            if self.__allow_undeclared:
                return ParameterDescriptor()
            raise self.__not_declared(name)
        return descriptor

    def describe_parameters(self, names: list[str]) -> list[ParameterDescriptor]:
        """Return the descriptors of several parameters. See `describe_parameter`."""
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
                raise self.__not_declared(name)
            before = self.__descriptors[name]
            if before.read_only:
                raise ParameterImmutableException(name)
            descriptor.name, descriptor.type = name, before.type
            parameter = self.__parameters[name]
            if alternative_value is not None and range_fault(parameter, descriptor):
                parameter = Parameter(name, value=parameter_value_to_python(alternative_value))
            if fault := range_fault(parameter, descriptor):
                raise InvalidParameterValueException(name, parameter.value, fault)
            self.__descriptors[name] = descriptor
            self.__parameters[name] = parameter
            return parameter.get_parameter_value()

    def __initial(
        self, name: str, value: Any, described_type: int, *, ignore_override: bool
    ) -> tuple[Parameter[Any], Parameter.Type]:
        """Return the parameter with its initial value, and its declared type."""
        if isinstance(value, Parameter.Type):
            default, expected = Parameter[Any](name), value
        else:
            default = with_type(Parameter(name, value=value), described_type)
            expected = default.type_
        if ignore_override or name not in self.__overrides:
            return default, expected
        parameter = Parameter(name, value=self.__overrides[name].value)
        if parameter.type_ is Parameter.Type.NOT_SET and is_array_type(expected):
            return Parameter(name, expected, []), expected
        if default.type_ is Parameter.Type.BYTE_ARRAY and is_empty(default) and is_array_type(parameter.type_):
            expected = parameter.type_
        return parameter, expected

    def __typed(self, parameter: Parameter[Any]) -> Parameter[Any]:
        """Return a parameter to be set with the type of its declaration, if either is an empty list without a type."""
        descriptor = self.__descriptors.get(parameter.name)
        if descriptor is None or descriptor.dynamic_typing:
            return parameter
        if parameter.name in self.__without_element_type and is_array_type(parameter.type_) and len(parameter.value):
            self.__without_element_type.discard(parameter.name)
            descriptor.type = parameter.type_.value
        return with_type(parameter, descriptor.type)

    def __check_declared(self, parameters: list[Parameter[Any]]) -> None:
        for parameter in parameters:
            if not isinstance(parameter, Parameter):
                error = TypeError(f"parameter must be instance of type '{Parameter!r}'")
                raise _with_hint(error, f"Got {parameter!r}.")
        unknown = self._Coframe__undeclared([parameter.name for parameter in parameters])
        if unknown:
            raise _with_hint(ParameterNotDeclaredException(unknown), self.__suggestion(unknown[0]))

    def _Coframe__undeclared(self, names: list[str]) -> list[str]:
        """Return the names that are not declared; none if undeclared parameters are allowed."""
        return [] if self.__allow_undeclared else [name for name in names if not self.has_parameter(name)]

    def __not_declared(self, name: str) -> ParameterNotDeclaredException:
        return _with_hint(ParameterNotDeclaredException(name), self.__suggestion(name))

    def __suggestion(self, name: str) -> str:
        guess = did_you_mean(name, self.__parameters)
        declared = guess or f"Declared: {', '.join(sorted(self.__parameters))}."
        return f"Call declare_parameter('{name}', ...) first. {declared}"

    def __set(self, parameters: list[Parameter[Any]]) -> SetParametersResult:
        parameters = [self.__typed(parameter) for parameter in parameters]
        for pre_set in list(self.__pre_set_callbacks):
            parameters = pre_set(parameters)
        if self.__pre_set_callbacks:
            if not parameters:
                reason = (
                    "parameter list cannot be empty, this might be due to pre_set_parameters_callback modifying the "
                )
                return SetParametersResult(successful=False, reason=f"{reason}original parameters list.")
            self.__check_declared(parameters)
        return self.__apply(parameters)

    def __apply(self, parameters: list[Parameter[Any]], *, is_declaration: bool = False) -> SetParametersResult:
        for parameter in parameters:
            descriptor = self.__descriptors.get(parameter.name)
            if descriptor is None:
                continue
            fault = range_fault(parameter, descriptor)
            if not is_declaration:
                fault = change_fault(parameter, descriptor) or fault
            if fault:
                return SetParametersResult(successful=False, reason=fault)
        for callback in list(self.__callbacks):
            result = callback(parameters)
            if not result.successful:
                return result
        event = ParameterEvent()
        for parameter in parameters:
            self.__store(parameter, event, is_declaration=is_declaration)
        self._Coframe__publish_parameter_event(event)
        for post_set in list(self.__post_set_callbacks):
            post_set(parameters)
        return SetParametersResult(successful=True)

    def __store(self, parameter: Parameter[Any], event: ParameterEvent, *, is_declaration: bool) -> None:
        name, before = parameter.name, self.__parameters.get(parameter.name)
        if parameter.type_ is Parameter.Type.NOT_SET and not is_declaration:
            if before is not None:
                event.deleted_parameters.append(before.to_parameter_msg())
            self.__parameters.pop(name, None)
            self.__descriptors.pop(name, None)
            return
        descriptor = self.__descriptors.setdefault(name, ParameterDescriptor(name=name, dynamic_typing=True))
        if descriptor.dynamic_typing:
            descriptor.type = parameter.type_.value
        is_new = before is None or before.type_ is Parameter.Type.NOT_SET
        (event.new_parameters if is_new else event.changed_parameters).append(parameter.to_parameter_msg())
        self.__parameters[name] = parameter
        self._Coframe__on_parameter_set(parameter)

    def _Coframe__on_parameter_set(self, parameter: Parameter[Any]) -> None:
        """Handle a new value of a parameter. Subclasses override this."""

    def _Coframe__publish_parameter_event(self, event: ParameterEvent) -> None:
        """Publish new, changed and deleted parameters. Subclasses override this."""


def _warn_of_missing_default(name: str) -> None:
    warnings.warn(
        f"when declaring parameter named '{name}', declaring a parameter only providing its name is deprecated. "
        "Pass a default value, a Parameter.Type, or a descriptor with dynamic_typing=True.",
        stacklevel=3,
    )


def _is_listed(name: str, prefixes: AbstractSet[str], depth: int) -> bool:
    """Return whether a name has one of the prefixes and is at most `depth` levels below it (0: any level)."""
    separator = PARAMETER_SEPARATOR_STRING
    is_wanted = not prefixes or name in prefixes or "" in prefixes
    if is_wanted and (not depth or name.count(separator) < depth):
        return True
    end = name.find(separator, 1)
    while end > 0:
        if name[:end] in prefixes and (not depth or name.count(separator, end + 1) < depth):
            return True
        end = name.find(separator, end + 1)
    return False
