# SPDX-License-Identifier: Apache-2.0
"""The attributes of nodes in XML and YAML launch files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.actions.execute_process import ExecuteProcess
from launch.substitutions import TextSubstitution
from launch_ros.parameter_descriptions import ParameterFile, ParameterValue

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser

__all__ = ["parse_node", "parse_parameters", "parse_remappings"]

_TYPES: dict[str, type] = {"bool": bool, "int": int, "float": float, "str": str}
_LIST = "list_of_"


def parse_node(entity: Entity, parser: Parser) -> dict[str, Any]:
    """Return the keyword arguments of a node."""
    found: dict[str, Any] = {}
    for name, keyword in (("args", "arguments"), ("ros_args", "ros_arguments")):
        text = entity.get_attr(name, optional=True)
        if text is not None:
            found[keyword] = ExecuteProcess._parse_cmdline(text, parser)  # noqa: SLF001
    found["executable"] = parser.parse_substitution(entity.get_attr("exec"))
    for name, keyword in (("pkg", "package"), ("name", "name"), ("exec_name", "exec_name"), ("namespace", "namespace")):
        text = entity.get_attr(name, optional=True)
        if text is not None:
            found[keyword] = parser.parse_substitution(text)
    if (remappings := parse_remappings(entity, parser)) is not None:
        found["remappings"] = remappings
    parameters = entity.get_attr("param", data_type=list, optional=True)
    if parameters is not None:
        found["parameters"] = parse_parameters(parameters, parser)
    return found


def parse_remappings(entity: Entity, parser: Parser) -> list[Any] | None:
    """Return the remappings of a node, or None."""
    rules = entity.get_attr("remap", data_type=list, optional=True)
    if rules is None:
        return None
    found = []
    for rule in rules:
        source = parser.parse_substitution(rule.get_attr("from"))
        found.append((source, parser.parse_substitution(rule.get_attr("to"))))
        rule.assert_entity_completely_parsed()
    return found


def parse_parameters(parameters: list[Entity], parser: Parser) -> list[Any]:
    """Return the parameters of a node in their order: files, and a dictionary of those between two files."""
    found: list[Any] = []
    for each in parameters:
        file = each.get_attr("from", optional=True)
        allow_substs = each.get_attr("allow_substs", data_type=bool, optional=True)
        name = each.get_attr("name", optional=True)
        if file is not None and name is not None:
            raise RuntimeError("name and from attributes are mutually exclusive")
        if file is not None:
            each.assert_entity_completely_parsed()
            found.append(ParameterFile(parser.parse_substitution(file), allow_substs=bool(allow_substs)))
        elif name is not None:
            parsed = _nested_parameters([each], parser)
            if found and isinstance(found[-1], dict) and not found[-1].keys() & parsed.keys():
                found[-1].update(parsed)
            else:
                found.append(parsed)
        else:
            raise ValueError("param Entity should have name or from attribute")
    return found


def _nested_parameters(parameters: list[Entity], parser: Parser) -> dict[Any, Any]:
    found: dict[Any, Any] = {}
    for each in parameters:
        name = tuple(parser.parse_substitution(each.get_attr("name")))
        kind = _type(each.get_attr("type", optional=True))
        value = each.get_attr("value", data_type=kind, optional=True)
        inner = each.get_attr("param", data_type=list, optional=True)
        if value is not None and inner:
            raise RuntimeError("nested parameters and value attributes are mutually exclusive")
        if value is None and not inner:
            raise RuntimeError("either a value attribute or nested params are needed")
        if inner:
            found[name] = _nested_parameters(inner, parser)
        else:
            performed = _value(value, parser)
            found[name] = performed if kind is None else ParameterValue(performed, value_type=kind)
        each.assert_entity_completely_parsed()
    return found


def _type(name: str | None) -> Any:
    """Return the type with a name such as ``str`` or ``list_of_str``, or None for that which YAML gives the value."""
    if name is None:
        return None
    scalar = _TYPES.get(name.removeprefix(_LIST))
    if scalar is None:
        known = ", ".join([*_TYPES, *(f"{_LIST}{each}" for each in _TYPES)])
        raise ValueError(f"{name!r} is not a type of a parameter, expected one of: {known}")
    return list[scalar] if name.startswith(_LIST) else scalar  # type: ignore[valid-type]


def _value(value: Any, parser: Parser) -> Any:
    if isinstance(value, list):
        return [_value(item, parser) for item in value]
    if not isinstance(value, str):
        return value
    parts = parser.parse_substitution(value)
    # The type of a text without substitutions is known.
    return parts[0].text if len(parts) == 1 and isinstance(parts[0], TextSubstitution) else parts
