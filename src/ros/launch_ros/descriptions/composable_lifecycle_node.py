# SPDX-License-Identifier: Apache-2.0
"""The description of a composable node with a life cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch_ros.descriptions.composable_node import ComposableNode
from launch_ros.utilities.lifecycle_event_manager import LifecycleEventManager

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.launch_context import LaunchContext

__all__ = ["ComposableLifecycleNode"]


class ComposableLifecycleNode(ComposableNode):
    """A lifecycle node for a container. When it is loaded, ChangeState events change its state.

    Args:
        autostart: Configure and activate the node when it has been loaded.
        options: Keyword arguments of ComposableNode.
    """

    def __init__(self, *, autostart: bool = False, **options: Any) -> None:
        super().__init__(**options)
        self.__autostart = autostart

    @property
    def node_autostart(self) -> bool:
        """Whether the node is configured and activated when it has been loaded."""
        return self.__autostart

    def start_events(
        self, context: LaunchContext, node_name: str, return_code_of_container: Callable[[], int | None]
    ) -> None:
        """Let events change the state of the loaded node, and emit its transitions as events."""
        LifecycleEventManager(_LoadedNode(node_name, return_code_of_container)).setup_lifecycle_manager(context)


class _LoadedNode:
    """A node in a container, as the source of lifecycle events."""

    is_lifecycle_node = True

    def __init__(self, node_name: str, return_code_of_container: Callable[[], int | None]) -> None:
        self.node_name = node_name
        self._return_code_of_container = return_code_of_container

    @property
    def return_code(self) -> int | None:
        return self._return_code_of_container()
