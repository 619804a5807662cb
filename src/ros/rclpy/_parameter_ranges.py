# SPDX-License-Identifier: Apache-2.0
"""Rules of parameter descriptors: types, read-only parameters and ranges. The messages are upstream's."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

from rclpy.parameter import Parameter

if TYPE_CHECKING:
    from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

RELATIVE_TOLERANCE: Final = 1e-6
_ARRAY_TYPES: Final = frozenset(kind for kind in Parameter.Type if kind.name.endswith("_ARRAY"))


def is_array_type(kind: int) -> bool:
    """Return whether the number of a parameter type stands for an array."""
    return kind in _ARRAY_TYPES


def is_empty(parameter: Parameter[Any]) -> bool:
    """Return whether a value is an empty array, which has no elements that have a type."""
    return parameter.type_ in _ARRAY_TYPES and not len(parameter.value)


def with_type(parameter: Parameter[Any], kind: int) -> Parameter[Any]:
    """Convert an empty array to another array type. Return other parameters unchanged."""
    if kind != parameter.type_ and is_array_type(kind) and is_empty(parameter):
        return Parameter(parameter.name, Parameter.Type(kind), [])
    return parameter


def change_fault(parameter: Parameter[Any], descriptor: ParameterDescriptor) -> str:
    """Return why a declared parameter must not be changed to this value, or an empty string if it may."""
    if descriptor.read_only:
        return f"Trying to set a read-only parameter: {parameter.name}."
    if not descriptor.dynamic_typing and parameter.type_ is Parameter.Type.NOT_SET:
        return "Static parameter cannot be undeclared"
    if not descriptor.dynamic_typing and parameter.type_.value != descriptor.type:
        return f"Wrong parameter type, expected '{Parameter.Type(descriptor.type)}' got '{parameter.type_}'"
    return ""


def range_fault(parameter: Parameter[Any], descriptor: ParameterDescriptor) -> str:
    """Return why a value is out of the range of the descriptor, or an empty string if it is in range."""
    faults: list[str] = []
    if parameter.type_ is Parameter.Type.INTEGER:
        faults = [_integer_fault(parameter, limits) for limits in descriptor.integer_range]
    elif parameter.type_ is Parameter.Type.DOUBLE:
        faults = [_floating_point_fault(parameter, limits) for limits in descriptor.floating_point_range]
    return next(filter(None, faults), "")


def _integer_fault(parameter: Parameter[Any], limits: IntegerRange) -> str:
    low, high, step, value = limits.from_value, limits.to_value, limits.step, parameter.value
    if not low <= value <= high:
        return f"Parameter {parameter.name} out of range. Min: {low}, Max: {high}, value: {value}"
    if step and value != high and (value - low) % step:
        return (
            f"The parameter value for {parameter.name} is not a valid step. Min: {low}, max: {high}, value: {value}, "
            f"step: {step}"
        )
    return ""


def _floating_point_fault(parameter: Parameter[Any], limits: FloatingPointRange) -> str:
    low, high, step, value = limits.from_value, limits.to_value, limits.step, parameter.value
    if math.isclose(value, low, rel_tol=RELATIVE_TOLERANCE) or math.isclose(value, high, rel_tol=RELATIVE_TOLERANCE):
        return ""
    if not low <= value <= high:
        return f"Parameter {parameter.name} out of range Min: {low}, Max: {high}, value: {value}"
    if step and not math.isclose(value, low + round((value - low) / step) * step, rel_tol=RELATIVE_TOLERANCE):
        return (
            f"The parameter value for {parameter.name} is not close enough to a valid step. Min: {low}, max: {high}, "
            f"value: {value}, step: {step}"
        )
    return ""
