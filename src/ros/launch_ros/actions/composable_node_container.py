# SPDX-License-Identifier: Apache-2.0
"""The action that runs a container of composable nodes in C++, which coframe cannot load."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import launch.logging
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions
from launch_ros.actions.load_composable_nodes import parse_composable_nodes, report
from launch_ros.actions.node import Node

if TYPE_CHECKING:
    from launch.action import Action
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch_ros.descriptions import ComposableNode

__all__ = ["ComposableNodeContainer"]


@expose_action("node_container")
class ComposableNodeContainer(Node):
    """A container of composable nodes; its execution logs an error, and the rest of the system is launched.

    Args:
        name: Name of the container.
        namespace: Namespace of the container.
        composable_node_descriptions: The composable nodes.
        options: Keyword arguments of Node.
    """

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType | None = None,
        composable_node_descriptions: list[ComposableNode] | None = None,
        **options: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **options)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__descriptions = composable_node_descriptions or []

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<node_container>`` with its ``<composable_node>``."""
        _, options = super().parse(entity, parser)
        return cls, options | {"composable_node_descriptions": parse_composable_nodes(entity, parser)}

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Log that composable nodes cannot be loaded."""
        report(context, launch.logging.get_logger("launch_ros"), self.__name, self.__descriptions)
        return None
