# SPDX-License-Identifier: Apache-2.0
"""The action that runs a lifecycle node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_action
from launch_ros.actions.lifecycle_transition import LifecycleTransition
from launch_ros.actions.node import Node
from launch_ros.utilities.lifecycle_event_manager import LifecycleEventManager

if TYPE_CHECKING:
    from launch.action import Action
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["LifecycleNode"]


@expose_action("lifecycle_node")
class LifecycleNode(Node):
    """Run a lifecycle node, change its state at ChangeState events, and emit StateTransition events.

    Args:
        name: Name of the node.
        namespace: Namespace of the node.
        autostart: Configure and activate the node when it has been started.
        options: Keyword arguments of Node.
    """

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType = "",
        autostart: bool = False,
        **options: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **options)
        self.__autostart = autostart
        self.__events = LifecycleEventManager(self)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<lifecycle_node>``, with the attributes of ``<node>`` and ``autostart``."""
        _, options = super().parse(entity, parser)
        autostart = entity.get_attr("autostart", data_type=bool, optional=True)
        return cls, options | {"autostart": bool(autostart)}

    @property
    def node_autostart(self) -> bool:
        """Whether the node is configured and activated when it has been started."""
        return self.__autostart

    @property
    def is_lifecycle_node(self) -> bool:
        """Whether the node has a life cycle."""
        return True

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Start the node, and subscribe to its transitions."""
        self._perform_substitutions(context)
        if not self.is_node_name_fully_specified():
            raise RuntimeError("node_name unexpectedly incomplete for lifecycle node")
        self.__events.setup_lifecycle_manager(context)
        result = super().execute(context) or []
        if self.__autostart:
            names = ["configure", "activate"]
            result.append(LifecycleTransition(lifecycle_node_names=[self.node_name], transition_ids=names))
        return result
