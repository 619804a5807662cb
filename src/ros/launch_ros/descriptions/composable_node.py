# SPDX-License-Identifier: Apache-2.0
"""The description of a composable node."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.utilities import normalize_to_list_of_substitutions
from launch_ros.utilities import normalize_parameters, normalize_remap_rules

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution
    from launch_ros.parameters_type import SomeParameters
    from launch_ros.remap_rule_type import SomeRemapRules

__all__ = ["ComposableNode"]


class ComposableNode:
    """A node in a C++ library, for a container.

    Args:
        package: Name of the package.
        plugin: Name of the class.
        name: Name of the node.
        namespace: Namespace of the node.
        parameters: Parameters of the node.
        remappings: Remappings of the node.
        extra_arguments: Arguments of the container for the node.
        condition: Load it only if this condition holds.
    """

    def __init__(
        self,
        *,
        package: SomeSubstitutionsType,
        plugin: SomeSubstitutionsType,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        parameters: SomeParameters | None = None,
        remappings: SomeRemapRules | None = None,
        extra_arguments: SomeParameters | None = None,
        condition: Condition | None = None,
    ) -> None:
        self.package = normalize_to_list_of_substitutions(package)
        self.node_plugin = normalize_to_list_of_substitutions(plugin)
        self.node_name = _optional(name)
        self.node_namespace = _optional(namespace)
        self.parameters = None if parameters is None else normalize_parameters(parameters)
        self.remappings = None if remappings is None else list(normalize_remap_rules(remappings))
        self.extra_arguments = None if extra_arguments is None else normalize_parameters(extra_arguments)
        self.condition = condition


def _optional(subs: SomeSubstitutionsType | None) -> list[Substitution] | None:
    return None if subs is None else normalize_to_list_of_substitutions(subs)
