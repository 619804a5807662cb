# SPDX-License-Identifier: Apache-2.0
"""Parameters in their general form: dictionaries with names and values of substitutions, and files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import PurePath
from typing import Any

from launch.substitution import Substitution
from launch.substitutions import TextSubstitution
from launch.utilities import normalize_to_list_of_substitutions
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue

__all__ = ["normalize_parameter_dict", "normalize_parameters"]


def normalize_parameters(parameters: Iterable[Any]) -> tuple[Any, ...]:
    """Return files, dictionaries and descriptions of parameters in their general form.

    Raises:
        TypeError: Something else is among them.
    """
    if isinstance(parameters, str | Mapping) or not isinstance(parameters, Sequence):
        raise TypeError(f"Expecting a sequence of parameters, got '{parameters}'")
    normalized: list[Any] = []
    for each in parameters:
        if isinstance(each, Mapping):
            normalized.append(normalize_parameter_dict(each))
        elif isinstance(each, Parameter | ParameterFile):
            normalized.append(each)
        elif isinstance(each, str | PurePath | Substitution | Sequence):
            normalized.append(ParameterFile(each if isinstance(each, Sequence | Substitution) else str(each)))
        else:
            raise TypeError(
                f"parameters are files, dictionaries, or launch_ros.descriptions.Parameter; got {type(each).__name__}"
            )
    return tuple(normalized)


def normalize_parameter_dict(
    parameters: Mapping[Any, Any], *, _prefix: Sequence[Substitution] = ()
) -> dict[tuple[Substitution, ...], Any]:
    """Return parameters by name; parameters in a nested dictionary have dotted names.

    Raises:
        TypeError: A name or a value has a type that parameters do not have.
    """
    normalized: dict[tuple[Substitution, ...], Any] = {}
    for name, value in parameters.items():
        if not isinstance(name, str | Substitution | Sequence):
            raise TypeError(f"the name of a parameter must be a string, got {name!r}")
        own = normalize_to_list_of_substitutions(name)
        full = (*_prefix, *([TextSubstitution(text=".")] if _prefix else []), *own)
        if isinstance(value, Mapping):
            normalized |= normalize_parameter_dict(value, _prefix=full)
        else:
            normalized[full] = _normalized_value(value, name)
    return normalized


def _normalized_value(value: Any, name: Any) -> Any:
    value = _as_builtin_type(value)
    if isinstance(value, ParameterValue | str | bool | int | float | bytes):
        return value  # A plain text stays a text, even if it looks like a number.
    if isinstance(value, Substitution):
        return [value]
    if isinstance(value, Sequence) or hasattr(value, "tolist"):
        items = value.tolist() if hasattr(value, "tolist") else [_as_builtin_type(item) for item in value]
        if any(isinstance(item, Substitution) for item in items) and all(
            isinstance(item, str | Substitution) for item in items
        ):
            return normalize_to_list_of_substitutions(items)  # one text that consists of several parts
        return tuple(_normalized_item(item, name) for item in _as_one_type(items, name))
    raise TypeError(
        f"the value of the parameter {name!r} has the type {type(value).__name__}; allowed are bool, int, float, str, "
        "bytes, sequences of one of them, and substitutions"
    )


def _as_builtin_type(value: Any) -> Any:
    """Return an IntEnum, a scalar of NumPy or another subclass as the type that YAML can represent."""
    if getattr(value, "ndim", None) == 0:
        value = value.item()
    kinds: tuple[type[Any], ...] = (int, float, bytes)
    for kind in kinds:
        if isinstance(value, kind) and not isinstance(value, bool):
            return kind(value)
    # str() would return the name of a member of an enumeration.
    return str.__str__(value) if isinstance(value, str) else value


def _as_one_type(items: list[Any], name: Any) -> list[Any]:
    types = {type(item) for item in items}
    if types == {int, float}:
        return [float(item) for item in items]
    plain = types & {bool, int, float, str, bytes}
    if len(plain) > 1:
        names = sorted(each.__name__ for each in plain)
        raise TypeError(f"all elements of the parameter {name!r} must have the same type, found {', '.join(names)}")
    return items


def _normalized_item(item: Any, name: Any) -> Any:
    if isinstance(item, bool | int | float | str | bytes | ParameterValue):
        return item
    if isinstance(item, Substitution) or (
        isinstance(item, Sequence) and all(isinstance(part, str | Substitution) for part in item)
    ):
        return normalize_to_list_of_substitutions(item)
    raise TypeError(f"an element of the parameter {name!r} has the type {type(item).__name__}")
