# SPDX-License-Identifier: Apache-2.0
"""The action that runs a lifecycle node."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

import launch.logging
from launch.actions.opaque_function import OpaqueFunction
from launch.event_handler import EventHandler
from launch.frontend.expose import expose_action
from launch_ros.actions.lifecycle_transition import LifecycleTransition
from launch_ros.actions.node import Node
from launch_ros.events.lifecycle import ChangeState, StateTransition
from launch_ros.ros_adapters import get_ros_node

if TYPE_CHECKING:
    from launch.action import Action
    from launch.event import Event
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from lifecycle_msgs.msg import TransitionEvent

__all__ = ["LifecycleNode"]

_CHECK_PERIOD = 1.0  # seconds between two checks whether the service is there
_ANSWER = 0.05  # seconds between two checks whether the node has answered


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
        self.__logger = launch.logging.get_logger("launch_ros")
        self.__current_state = "unconfigured"
        self.__tasks: set[asyncio.Task[None]] = set()

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
        from lifecycle_msgs.msg import TransitionEvent  # noqa: PLC0415 - slow to import
        from lifecycle_msgs.srv import ChangeState as ChangeStateService  # noqa: PLC0415

        self._perform_substitutions(context)
        if not self.is_node_name_fully_specified():
            raise RuntimeError("node_name unexpectedly incomplete for lifecycle node")
        node = get_ros_node(context)
        self.__subscription = node.create_subscription(
            TransitionEvent,
            f"{self.node_name}/transition_event",
            lambda message: self.__on_transition(context, message),
            10,
        )
        self.__client = node.create_client(ChangeStateService, f"{self.node_name}/change_state")

        def matches(event: Event) -> bool:
            return isinstance(event, ChangeState) and event.lifecycle_node_matcher(self)

        action = OpaqueFunction(function=self.__on_change_state)
        context.register_event_handler(EventHandler(matcher=matches, entities=action))
        result = super().execute(context) or []
        if self.__autostart:
            names = ["configure", "activate"]
            result.append(LifecycleTransition(lifecycle_node_names=[self.node_name], transition_ids=names))
        return result

    def __on_transition(self, context: LaunchContext, message: TransitionEvent) -> None:
        loop = context.asyncio_loop
        self.__current_state = message.goal_state.label
        if loop is not None:  # This runs in the thread of the node.
            loop.call_soon_threadsafe(context.emit_event_sync, StateTransition(action=self, msg=message))

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
            if context.is_shutdown or self.return_code is not None:
                self.__logger.warning(f"Abandoning wait for the '{service}' service, due to shutdown")
                return
            if reason := getattr(self.__client, "_Coframe__refusal", ""):  # not in the rclpy of a sourced ROS
                self.__logger.error(reason)
                return
            self.__logger.info(f"Waiting for the '{service}' service")
        request = self.__client.srv_type.Request()
        request.transition.id = transition_id
        response = self.__client.call_async(request)
        while not response.done():
            if self.return_code is not None:
                self.__logger.error(f"{self.node_name} has ended before the transition '{name}'")
                return
            await asyncio.sleep(_ANSWER)
        result = response.result()
        if result is None or not result.success:
            self.__logger.error(
                f"Failed to make transition '{name}' for LifecycleNode '{self.node_name}', whose state is "
                f"'{self.__current_state}'"
            )
