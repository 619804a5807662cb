# SPDX-License-Identifier: Apache-2.0
"""The substitution of a copy of a parameter file with other values and names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe._files.bounded_yaml import MAX_BYTES
from coframe._files.regular_files import read_regular_text
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.yaml_loading import dump_yaml, load_yaml
from launch_ros.temporary_files import write_temporary_file

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["RewrittenYaml"]

_PARAMETERS = "ros__parameters"


class RewrittenYaml(Substitution):
    """The path of a copy of a YAML file with other values.

    Args:
        source_file: The path of the YAML file to copy.
        param_rewrites: The new values by keys. A key is the name of a parameter anywhere in the file, or the path of
            one: ``amcl.ros__parameters.use_sim_time``. A path with ``ros__parameters`` is added if it does not exist.
        root_key: A key under which the content is put, such as a namespace.
        key_rewrites: New names of keys.
        convert_types: Whether new values that are numbers are written as numbers, not as strings.
        value_rewrites: A mapping from old values, which must be strings, to new values.
    """

    def __init__(
        self,
        source_file: SomeSubstitutionsType,
        param_rewrites: Mapping[str, SomeSubstitutionsType],
        root_key: SomeSubstitutionsType | None = None,
        key_rewrites: Mapping[str, SomeSubstitutionsType] | None = None,
        convert_types: bool = False,
        value_rewrites: Mapping[str, SomeSubstitutionsType] | None = None,
    ) -> None:
        self.__source_file = normalize_to_list_of_substitutions(source_file)
        self.__param_rewrites = _normalize_pairs(param_rewrites)
        self.__key_rewrites = _normalize_pairs(key_rewrites or {})
        self.__value_rewrites = _normalize_pairs(value_rewrites or {})
        self.__root_key = None if root_key is None else normalize_to_list_of_substitutions(root_key)
        self.__convert_types = convert_types

    @property
    def name(self) -> list[Substitution]:
        """The path of the file."""
        return self.__source_file

    def describe(self) -> str:
        """Return nothing, as upstream."""
        return ""

    def perform(self, context: LaunchContext) -> str:
        """Return the path of the copy."""
        data: Any = load_yaml(read_regular_text(perform_substitutions(context, self.__source_file), MAX_BYTES)) or {}
        rewrites = {
            key: self._convert_text(perform_substitutions(context, value))
            for key, value in self.__param_rewrites.items()
        }
        _rewrite_everywhere(data, rewrites)
        paths = set(_paths(data))
        for path, value in rewrites.items():
            parts = path.split(".")
            if path in paths or _PARAMETERS in parts:
                _set(data, parts, value)
        _rewrite_keys(data, {key: perform_substitutions(context, new) for key, new in self.__key_rewrites.items()})
        _rewrite_values(
            data,
            {
                old: self._convert_text(perform_substitutions(context, new))
                for old, new in self.__value_rewrites.items()
            },
        )
        root = "" if self.__root_key is None else perform_substitutions(context, self.__root_key)
        return str(write_temporary_file(dump_yaml({root: data} if root else data)))

    def _convert_text(self, text: str) -> Any:
        if self.__convert_types:
            try:
                return float(text) if "." in text else int(text)
            except ValueError:
                pass
        return {"true": True, "false": False}.get(text.lower(), text)


def _normalize_pairs(pairs: Mapping[str, SomeSubstitutionsType]) -> dict[str, list[Substitution]]:
    return {key: normalize_to_list_of_substitutions(value) for key, value in pairs.items()}


def _rewrite_everywhere(data: Any, rewrites: Mapping[str, Any]) -> None:
    """Set each key with one of these names, at any depth."""
    if isinstance(data, dict):
        for key, value in data.items():
            _rewrite_everywhere(value, rewrites)
            if key in rewrites:
                data[key] = rewrites[key]


def _paths(data: Any, prefix: str = "") -> Iterator[str]:
    """Yield the path of each value; elements of lists have their number."""
    if isinstance(data, dict | list):
        for key, value in data.items() if isinstance(data, dict) else enumerate(data):
            yield from _paths(value, f"{prefix}.{key}" if prefix else str(key))
    else:
        yield prefix


def _set(data: Any, parts: list[str], value: Any) -> None:
    """Set the value at a path, and create the dictionaries of the path."""
    for part in parts[:-1]:
        if isinstance(data, list):
            data = data[int(part)]
            continue
        if not isinstance(data.get(part), dict | list):
            data[part] = {}
        data = data[part]
    data[int(parts[-1]) if isinstance(data, list) else parts[-1]] = value


def _rewrite_keys(data: Any, rewrites: Mapping[str, str]) -> None:
    if isinstance(data, dict) and rewrites:
        for key in list(data):
            value = data[key]
            if key in rewrites:
                del data[key]
                data[rewrites[key]] = value
            _rewrite_keys(value, rewrites)


def _rewrite_values(data: Any, rewrites: Mapping[str, Any]) -> None:
    if isinstance(data, dict | list) and rewrites:
        for key, value in list(data.items() if isinstance(data, dict) else enumerate(data)):
            if isinstance(value, str) and value in rewrites:
                data[key] = rewrites[value]
            _rewrite_values(value, rewrites)
