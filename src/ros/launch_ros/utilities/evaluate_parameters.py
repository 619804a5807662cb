# SPDX-License-Identifier: Apache-2.0
"""Parameters with all substitutions performed."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from launch.substitution import Substitution
from launch.utilities import perform_substitutions
from launch.utilities.type_utils import SCALAR_TYPES
from launch.utilities.yaml_loading import load_yaml
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from launch.launch_context import LaunchContext

__all__ = ["evaluate_parameter_dict", "evaluate_parameters"]

_ADVICE = (
    "If the parameter is meant to be a string, try wrapping it in "
    "launch_ros.parameter_descriptions.ParameterValue(value, value_type=str)"
)


def evaluate_parameters(context: LaunchContext, parameters: Iterable[Any]) -> list[dict[str, Any] | Path | Parameter]:
    """Return the values of normalized parameters: dictionaries, paths of files, and descriptions."""
    found: list[dict[str, Any] | Path | Parameter] = []
    for each in parameters:
        if isinstance(each, ParameterFile):
            found.append(each.evaluate(context))
        elif isinstance(each, Parameter):
            found.append(each)
        elif isinstance(each, dict):
            found.append(evaluate_parameter_dict(context, each))
        else:
            found.append(Path(each))
    return found


def evaluate_parameter_dict(
    context: LaunchContext, parameters: Mapping[tuple[Substitution, ...], Any]
) -> dict[str, Any]:
    """Return the values of normalized parameters by name.

    Raises:
        TypeError: The text of a value has a type that parameters do not have.
        ValueError: The text of a value is not YAML.
    """
    found = {}
    for parts, value in parameters.items():
        name = perform_substitutions(context, parts)
        found[name] = _evaluate(context, name, value)
    return found


def _evaluate(context: LaunchContext, name: str, value: Any) -> Any:
    if isinstance(value, ParameterValue):
        return value.evaluate(context)
    if isinstance(value, list):  # the parts of a text
        return _parse_yaml_value(name, perform_substitutions(context, value))
    if isinstance(value, tuple):
        return [_item(context, item) for item in value]
    return list(value) if isinstance(value, bytes) else value


def _item(context: LaunchContext, item: Any) -> Any:
    if isinstance(item, ParameterValue):
        return item.evaluate(context)
    if isinstance(item, list) and all(isinstance(part, Substitution) for part in item):
        return perform_substitutions(context, item)
    return item


def _parse_yaml_value(name: str, text: str) -> Any:
    """Convert a string to the type that YAML gives it."""
    try:
        value = load_yaml(text)
    except ValueError as error:
        raise ValueError(f"Unable to parse the value of parameter {name} as yaml. {_ADVICE}\n{error}") from None
    if value is None:
        return ""
    if isinstance(value, SCALAR_TYPES):
        return value
    if isinstance(value, list) and all(isinstance(item, SCALAR_TYPES) for item in value):
        types = {type(item) for item in value}
        return [float(item) for item in value] if types == {int, float} else value
    raise TypeError(
        "Allowed value types are bytes, bool, int, float, str, Sequence[bool], Sequence[int], Sequence[float], "
        f"Sequence[str]. Got {type(value)} for the parameter {name}. {_ADVICE}"
    )
