# SPDX-License-Identifier: Apache-2.0
"""The events of a lifecycle node: transitions that are asked for, and those that have happened."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any, Protocol

import launch.logging
from launch.actions.opaque_function import OpaqueFunction
from launch.event_handler import EventHandler
from launch_ros.events.lifecycle import ChangeState, StateTransition
from launch_ros.ros_adapters import get_ros_node

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from lifecycle_msgs.msg import TransitionEvent

__all__ = ["LifecycleEventManager", "ManagedNode"]

_CHECK_PERIOD = 1.0  # seconds between two checks whether the service is there
_ANSWER = 0.05  # seconds between two checks whether the node has answered


class ManagedNode(Protocol):
    """What has events of a lifecycle node."""

    @property
    def node_name(self) -> str:
        """Full name of the node."""

    @property
    def return_code(self) -> int | None:
        """The exit code of its process, or None while it runs."""


class LifecycleEventManager:
    """Changes the state of a node at ChangeState events, and emits StateTransition events.

    Args:
        lifecycle_node: The node, which the events contain.
    """

    def __init__(self, lifecycle_node: ManagedNode) -> None:
        self.__node = lifecycle_node
        self.__logger = launch.logging.get_logger("launch_ros")
        self.__current_state = "unconfigured"
        self.__tasks: set[asyncio.Task[None]] = set()

    @property
    def node_name(self) -> str:
        """Full name of the node."""
        return self.__node.node_name

    def setup_lifecycle_manager(self, context: LaunchContext) -> None:
        """Subscribe to the transitions of the node, and wait for events."""
        from lifecycle_msgs.msg import TransitionEvent  # noqa: PLC0415 - slow to import
        from lifecycle_msgs.srv import ChangeState as ChangeStateService  # noqa: PLC0415

        node = get_ros_node(context)
        self.__subscription = node.create_subscription(
            TransitionEvent,
            f"{self.node_name}/transition_event",
            lambda message: self.__on_transition(context, message),
            10,
        )
        self.__client = node.create_client(ChangeStateService, f"{self.node_name}/change_state")

        def matches(event: Event) -> bool:
            return isinstance(event, ChangeState) and event.lifecycle_node_matcher(self.__node)  # type: ignore[arg-type]

        action = OpaqueFunction(function=self.__on_change_state)
        context.register_event_handler(EventHandler(matcher=matches, entities=action))

    def __on_transition(self, context: LaunchContext, message: TransitionEvent) -> None:
        loop = context.asyncio_loop
        self.__current_state = message.goal_state.label
        if loop is not None:  # This runs in the thread of the node.
            event = StateTransition(action=self.__node, msg=message)  # type: ignore[arg-type]
            loop.call_soon_threadsafe(context.emit_event_sync, event)

    def __on_change_state(self, context: LaunchContext) -> None:
        task = asyncio.ensure_future(self.__change_state(context, context.locals.event.transition_id))
        self.__tasks.add(task)
        task.add_done_callback(self.__tasks.discard)
        context.add_completion_future(task)

    async def __change_state(self, context: LaunchContext, transition_id: int) -> None:
        """Call the service. This waits for the node as long as the system is not shut down."""
        name = ChangeState.valid_transitions[transition_id]
        loop = asyncio.get_running_loop()
        service = f"{self.node_name}/change_state"
        while not await loop.run_in_executor(None, self.__client.wait_for_service, _CHECK_PERIOD):
            if context.is_shutdown or self.__node.return_code is not None:
                self.__logger.warning(f"Abandoning wait for the '{service}' service, due to shutdown")
                return
            if reason := getattr(self.__client, "_Coframe__refusal", ""):  # not in the rclpy of a sourced ROS
                self.__logger.error(reason)
                return
            self.__logger.info(f"Waiting for the '{service}' service")
        request: Any = self.__client.srv_type.Request()
        request.transition.id = transition_id
        response = self.__client.call_async(request)
        while not response.done():
            if self.__node.return_code is not None:
                self.__logger.error(f"{self.node_name} has ended before the transition '{name}'")
                return
            await asyncio.sleep(_ANSWER)
        result = response.result()
        if result is None or not result.success:
            self.__logger.error(
                f"Failed to make transition '{name}' for LifecycleNode '{self.node_name}', whose state is "
                f"'{self.__current_state}'"
            )
