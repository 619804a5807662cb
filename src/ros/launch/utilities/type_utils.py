# SPDX-License-Identifier: Apache-2.0
"""Values whose type is only known after their substitutions were performed."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Union, get_args, get_origin

from launch.substitution import Substitution
from launch.utilities.normalizing import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.yaml_loading import load_yaml

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = [
    "SCALAR_TYPES",
    "AllowedTypesTuple",
    "AllowedTypesType",
    "AllowedValueType",
    "ScalarTypesTuple",
    "SomeValueType",
    "coerce_list",
    "coerce_to_type",
    "extract_type",
    "get_typed_value",
    "is_instance_of",
    "is_normalized_substitution",
    "is_substitution",
    "is_typing_list",
    "normalize_typed_substitution",
    "perform_typed_substitution",
]

AllowedTypesType = Any
AllowedValueType = Union[str, int, float, bool, list[str], list[int], list[float], list[bool]]  # noqa: UP007
SomeValueType = Any
SCALAR_TYPES = (int, float, bool, str)
ScalarTypesTuple = SCALAR_TYPES
AllowedTypesTuple = (*SCALAR_TYPES, list[int], list[float], list[bool], list[str])


def is_typing_list(data_type: Any) -> bool:
    """Return whether a type is `List` or `List[...]`."""
    return data_type is list or get_origin(data_type) is list


def extract_type(data_type: Any) -> tuple[Any, bool]:
    """Return the scalar type of a type, and whether the type is a list of it."""
    if is_typing_list(data_type):
        arguments = get_args(data_type)
        return (arguments[0] if arguments else None), True
    return data_type, False


def is_instance_of(value: Any, data_type: Any, *, can_be_str: bool = False) -> bool:
    """Return whether a value has a type such as `int` or `List[int]`. With `can_be_str`, strings also count."""
    if data_type is None:
        return True
    if can_be_str and (isinstance(value, str) or (isinstance(value, list) and all(isinstance(v, str) for v in value))):
        return True
    scalar, is_list = extract_type(data_type)
    if is_list:
        return isinstance(value, list) and all(scalar is None or type(item) is scalar for item in value)
    return type(value) is scalar


def coerce_to_type(value: str, data_type: Any = None, *, can_be_str: bool = False) -> Any:
    """Convert a string to the given type or, with None, to the type that YAML gives it.

    Raises:
        ValueError: The text is not a value of this type.
    """
    if data_type is str:
        return value
    try:
        parsed = load_yaml(value)
    except ValueError:
        parsed = value
    scalar, is_list = extract_type(data_type)
    if data_type is None:
        is_scalar_or_list = isinstance(parsed, SCALAR_TYPES) or _is_uniform_list(parsed)
        return parsed if is_scalar_or_list else value
    if is_list and isinstance(parsed, list):
        return [_scalar(item, scalar, value) for item in parsed]
    if not is_list:
        try:
            return _scalar(parsed, scalar, value)
        except ValueError:
            if can_be_str:
                return value
            raise
    raise ValueError(f"Failed to convert '{value}' to '{data_type}'")


def _scalar(parsed: Any, scalar: Any, text: str) -> Any:
    if scalar is None or type(parsed) is scalar:
        return parsed
    if scalar is float and type(parsed) is int:
        return float(parsed)
    if scalar is float and isinstance(parsed, str):
        return float(parsed)  # YAML takes 1e5 as a text.
    if scalar is str:
        return str(parsed)
    raise ValueError(f"Failed to convert '{text}' to '{scalar.__name__}'")


def _is_uniform_list(value: Any) -> bool:
    return isinstance(value, list) and len({type(item) for item in value}) <= 1


def coerce_list(value: Iterable[str], data_type: Any = None, *, can_be_str: bool = False) -> list[Any]:
    """Return the values of several strings."""
    return [coerce_to_type(item, data_type, can_be_str=can_be_str) for item in value]


def get_typed_value(value: str | list[str], data_type: Any, *, can_be_str: bool = False) -> Any:
    """Return the value of a string or list of strings as the given type."""
    if isinstance(value, list):
        return coerce_list(value, extract_type(data_type)[0], can_be_str=can_be_str)
    return coerce_to_type(value, data_type, can_be_str=can_be_str)


def is_substitution(value: Any) -> bool:
    """Return whether a value is a substitution or contains one."""
    if isinstance(value, Iterable) and not isinstance(value, str):
        return any(is_substitution(item) for item in value)
    return isinstance(value, Substitution)


def is_normalized_substitution(value: Any) -> bool:
    """Return whether a value is a list of substitutions."""
    return isinstance(value, list) and bool(value) and all(isinstance(item, Substitution) for item in value)


def normalize_typed_substitution(value: Any, data_type: Any) -> Any:
    """Return a value as it is, or its substitutions as a list; `perform_typed_substitution` computes it.

    Raises:
        TypeError: A value without substitutions has another type.
    """
    if is_substitution(value):
        scalar, is_list = extract_type(data_type)
        if is_list and isinstance(value, list) and not all(isinstance(v, str | Substitution) for v in value):
            return [normalize_typed_substitution(item, scalar) for item in value]
        return normalize_to_list_of_substitutions(value)
    if isinstance(value, str) and data_type is not None and not is_instance_of(value, data_type):
        return normalize_to_list_of_substitutions(value)
    if data_type is float and type(value) is int:
        return float(value)
    if not is_instance_of(value, data_type):
        raise TypeError(f"value='{value}' is not an instance of {data_type}")
    return value


def perform_typed_substitution(context: LaunchContext, value: Any, data_type: Any) -> Any:
    """Return the value of a normalized typed substitution."""
    if is_normalized_substitution(value):
        return coerce_to_type(perform_substitutions(context, value), data_type)
    if isinstance(value, Substitution):
        return coerce_to_type(value.perform(context), data_type)
    if isinstance(value, list):
        scalar = extract_type(data_type)[0]
        return [perform_typed_substitution(context, item, scalar) for item in value]
    return value
