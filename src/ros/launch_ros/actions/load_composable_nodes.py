# SPDX-License-Identifier: Apache-2.0
"""The action that loads composable nodes in C++ into a container, which coframe cannot do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import launch.logging
from launch.action import Action
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.actions.node_parsing import parse_parameters, parse_remappings
from launch_ros.descriptions.composable_node import ComposableNode

if TYPE_CHECKING:
    import logging

    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.substitution import Substitution

__all__ = ["LoadComposableNodes", "parse_composable_nodes", "report"]


@expose_action("load_composable_node")
class LoadComposableNodes(Action):
    """Load composable nodes; its execution logs an error, and the rest of the system is launched.

    Args:
        composable_node_descriptions: The composable nodes.
        target_container: Name of the container, or the action that runs it.
        condition: Load them only if this condition holds.
    """

    def __init__(
        self, *, composable_node_descriptions: list[ComposableNode], target_container: Any, **options: Any
    ) -> None:
        super().__init__(**options)
        self.__descriptions = composable_node_descriptions
        is_action = isinstance(target_container, Action)
        self.__target = normalize_to_list_of_substitutions("the container" if is_action else target_container)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<load_composable_node target=...>`` with its ``<composable_node>``."""
        _, options = super().parse(entity, parser)
        options["target_container"] = parser.parse_substitution(entity.get_attr("target"))
        return cls, options | {"composable_node_descriptions": parse_composable_nodes(entity, parser) or []}

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Log that composable nodes cannot be loaded."""
        report(context, launch.logging.get_logger("launch_ros"), self.__target, self.__descriptions)
        return None


def parse_composable_nodes(entity: Entity, parser: Parser) -> list[ComposableNode] | None:
    """Return the composable nodes of an element, or None."""
    children = entity.get_attr("composable_node", data_type=list, optional=True)
    found = []
    for child in children or ():
        options: dict[str, Any] = {}
        for name, keyword in (
            ("pkg", "package"),
            ("plugin", "plugin"),
            ("name", "name"),
            ("namespace", "namespace"),
        ):
            text = child.get_attr(name, optional=name not in {"pkg", "plugin"})
            if text is not None:
                options[keyword] = parser.parse_substitution(text)
        parameters = child.get_attr("param", data_type=list, optional=True)
        if parameters is not None:
            options["parameters"] = parse_parameters(parameters, parser)
        options["remappings"] = parse_remappings(child, parser)
        extra = child.get_attr("extra_arg", data_type=list, optional=True)
        if extra is not None:
            options["extra_arguments"] = parse_parameters(extra, parser)
        found.append(ComposableNode(**options))
    return found if children is not None else None


def report(
    context: LaunchContext, logger: logging.Logger, target: list[Substitution], descriptions: list[ComposableNode]
) -> None:
    """Log an error that names the composable nodes and what to do."""
    plugins = [perform_substitutions(context, each.node_plugin) for each in descriptions]
    logger.error(
        f"{perform_substitutions(context, target)}: composable nodes are C++ libraries, which need a ROS 2 "
        f"installation; not loaded: {', '.join(plugins) or 'an empty container'}. Use nodes in Python with Node(...), "
        "or source a ROS 2 for this launch file."
    )
