# SPDX-License-Identifier: Apache-2.0
"""The action that runs a container of composable nodes, and loads nodes into it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_action
from launch_ros.actions.load_composable_nodes import LoadComposableNodes, parse_composable_nodes
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
    """Run a container, and load composable nodes into it.

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
        self.__descriptions = composable_node_descriptions

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<node_container>`` with its ``<composable_node>``."""
        _, options = super().parse(entity, parser)
        return cls, options | {"composable_node_descriptions": parse_composable_nodes(entity, parser)}

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Start the container, and return the action that loads its nodes."""
        actions: list[Any] = []
        if self.__descriptions:
            actions.append(LoadComposableNodes(composable_node_descriptions=self.__descriptions, target_container=self))
        return [*(super().execute(context) or ()), *actions]
