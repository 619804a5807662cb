# SPDX-License-Identifier: Apache-2.0
"""Parameters as text: the output of ``ros2 param``, and YAML parameter files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.cli.output import fail

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

__all__ = ["TYPE_NAMES", "as_yaml_file", "description_lines", "parameters_of_file", "python_value", "value_line"]

# Numbers of rcl_interfaces/msg/ParameterType: name of the type, field of the value, words before the value.
_TYPES = {
    1: ("boolean", "bool_value", "Boolean value is"),
    2: ("integer", "integer_value", "Integer value is"),
    3: ("double", "double_value", "Double value is"),
    4: ("string", "string_value", "String value is"),
    5: ("byte array", "byte_array_value", "Byte values are"),
    6: ("boolean array", "bool_array_value", "Boolean values are"),
    7: ("integer array", "integer_array_value", "Integer values are"),
    8: ("double array", "double_array_value", "Double values are"),
    9: ("string array", "string_array_value", "String values are"),
}
TYPE_NAMES = {0: "not set", **{number: name for number, (name, _, _) in _TYPES.items()}}


def python_value(value: Any) -> Any:
    """Return a `ParameterValue` as a Python value, or None if it is not set."""
    if value.type not in _TYPES:
        return None
    builtin_value = getattr(value, _TYPES[value.type][1])
    if isinstance(builtin_value, (bool, int, float, str)):
        return builtin_value
    return [int.from_bytes(item, "little") if isinstance(item, bytes) else item for item in builtin_value]


def value_line(value: Any, *, hide_type: bool) -> str | None:
    """Return the line of ``ros2 param get``, or None if the parameter is not set."""
    if value.type not in _TYPES:
        return None
    builtin_value = python_value(value)
    return str(builtin_value) if hide_type else f"{_TYPES[value.type][2]}: {builtin_value}"


def description_lines(descriptor: Any) -> Iterator[str]:
    """Yield the lines of ``ros2 param describe``."""
    yield f"Parameter name: {descriptor.name}"
    yield f"  Type: {TYPE_NAMES.get(descriptor.type, 'unknown')}"
    if descriptor.description:
        yield f"  Description: {descriptor.description}"
    yield "  Constraints:"
    if descriptor.read_only:
        yield "    Read only: true"
    for limits in (*descriptor.floating_point_range, *descriptor.integer_range):
        yield f"    Min value: {limits.from_value}"
        yield f"    Max value: {limits.to_value}"
        if limits.step:
            yield f"    Step: {limits.step}"
    if descriptor.additional_constraints:
        yield f"    Additional constraints: {descriptor.additional_constraints}"


def as_yaml_file(node_name: str, values: Mapping[str, Any]) -> str:
    """Return parameters as the text of a file for --params-file; dots in names become levels.

    Args:
        node_name: Full name of the node.
        values: Python values by name.
    """
    import yaml  # noqa: PLC0415 - an optional package

    tree: dict[str, Any] = {}
    for name, value in sorted(values.items()):
        *levels, last = name.split(".")
        branch = tree
        for level in levels:
            below = branch.setdefault(level, {})
            if not isinstance(below, dict):  # A parameter `a` beside a parameter `a.b`.
                branch, last = tree, name
                break
            branch = below
        branch[last] = value
    text: str = yaml.safe_dump({node_name: {"ros__parameters": tree}}, default_flow_style=False, allow_unicode=True)
    return text


def parameters_of_file(file: Path, node_name: str, *, use_wildcard: bool) -> dict[str, Any]:
    """Return a node's parameters from a YAML file, or end the command if there are none.

    Args:
        file: File in the format of --params-file.
        node_name: Full name of the node.
        use_wildcard: Whether to include parameters under /**.
    """
    from rclpy.parameter import parameter_dict_from_yaml_file  # noqa: PLC0415 - slow import

    try:
        messages = parameter_dict_from_yaml_file(str(file), use_wildcard, target_nodes=[node_name])
    except RuntimeError as error:
        fail(str(error))
    return {name: message.value for name, message in messages.items()}
