# SPDX-License-Identifier: Apache-2.0
"""Lifecycle nodes."""

from __future__ import annotations

import traceback
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from lifecycle_msgs.msg import State as StateMsg
from lifecycle_msgs.msg import Transition, TransitionDescription, TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetAvailableStates, GetAvailableTransitions, GetState
from rclpy import _absent
from rclpy.exceptions import RCLError
from rclpy.lifecycle.managed_entity import ManagedEntity
from rclpy.lifecycle.publisher import LifecyclePublisher
from rclpy.lifecycle.state_machine import STATES, Edge, StateMachine, TransitionCallbackReturn
from rclpy.node import Node

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.publisher import Publisher

_CALLBACKS = {
    StateMsg.TRANSITION_STATE_CONFIGURING: "on_configure",
    StateMsg.TRANSITION_STATE_CLEANINGUP: "on_cleanup",
    StateMsg.TRANSITION_STATE_SHUTTINGDOWN: "on_shutdown",
    StateMsg.TRANSITION_STATE_ACTIVATING: "on_activate",
    StateMsg.TRANSITION_STATE_DEACTIVATING: "on_deactivate",
    StateMsg.TRANSITION_STATE_ERRORPROCESSING: "on_error",
}


class LifecycleState(NamedTuple):
    """A state of a lifecycle node."""

    label: str
    state_id: int


class LifecycleNodeMixin(ManagedEntity):
    """Base class that gives a lifecycle to a node, which must be initialized first.

    Subclasses override the callbacks `on_configure`, `on_activate`, ..., which return a TransitionCallbackReturn. The
    callbacks of this class call those of the managed entities, such as the lifecycle publishers.

    Args:
        enable_communication_interface: Whether other programs can read and change the state. Otherwise only the methods
            `trigger_configure`, `trigger_activate`, ... change it.
        callback_group: Group of the lifecycle services. None: the default group of the node.
    """

    def __init__(
        self, *, enable_communication_interface: bool = True, callback_group: CallbackGroup | None = None
    ) -> None:
        self.__entities: list[ManagedEntity] = []
        self.__events: Publisher | None = None
        self._state_machine = StateMachine(self.__publish_event)
        if enable_communication_interface:
            self.__serve(callback_group)

    def trigger_configure(self) -> TransitionCallbackReturn:
        """Configure the node.

        Returns:
            The result of the callback.

        Raises:
            RCLError: The node is not unconfigured.
        """
        return self.__change_state("configure")

    def trigger_cleanup(self) -> TransitionCallbackReturn:
        """Undo the configuration of an inactive node. See `trigger_configure`."""
        return self.__change_state("cleanup")

    def trigger_shutdown(self) -> TransitionCallbackReturn:
        """Finalize the node. See `trigger_configure`."""
        return self.__change_state("shutdown")

    def trigger_activate(self) -> TransitionCallbackReturn:
        """Activate an inactive node. See `trigger_configure`."""
        return self.__change_state("activate")

    def trigger_deactivate(self) -> TransitionCallbackReturn:
        """Deactivate an active node. See `trigger_configure`."""
        return self.__change_state("deactivate")

    def add_managed_entity(self, entity: ManagedEntity) -> None:
        """Add an entity whose callbacks are called at the transitions of the node."""
        self.__entities.append(entity)

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Configure all managed entities."""
        return self.__call_entities("on_configure", state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Clean up all managed entities."""
        return self.__call_entities("on_cleanup", state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Shut down all managed entities."""
        return self.__call_entities("on_shutdown", state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Activate all managed entities."""
        return self.__call_entities("on_activate", state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Deactivate all managed entities."""
        return self.__call_entities("on_deactivate", state)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Handle an error in all managed entities."""
        return self.__call_entities("on_error", state)

    def create_lifecycle_publisher(self, *args: Any, **kwargs: Any) -> LifecyclePublisher:
        """Create a publisher that publishes only while the node is active.

        The arguments are the same as for `Node.create_publisher` without `publisher_class`.

        Raises:
            TypeError: The argument `publisher_class` is given.
        """
        if "publisher_class" in kwargs:
            raise TypeError(
                "create_publisher() got an unexpected keyword argument 'publisher_class': lifecycle publishers are "
                "of the class LifecyclePublisher."
            )
        publisher = self.__node.create_publisher(*args, **kwargs, publisher_class=LifecyclePublisher)
        assert isinstance(publisher, LifecyclePublisher)
        self.__entities.append(publisher)
        return publisher

    def destroy_lifecycle_publisher(self, publisher: LifecyclePublisher) -> bool:
        """Destroy a lifecycle publisher. Return False if it does not belong to this node."""
        if publisher in self.__entities:
            self.__entities.remove(publisher)
        return self.__node.destroy_publisher(publisher)

    @property
    def __node(self) -> Node:
        assert isinstance(self, Node), "LifecycleNodeMixin must be combined with rclpy.node.Node"
        return self

    def __call_entities(self, callback: str, state: LifecycleState) -> TransitionCallbackReturn:
        for entity in list(self.__entities):
            result: TransitionCallbackReturn = getattr(entity, callback)(state)
            if result is not TransitionCallbackReturn.SUCCESS:
                return result
        return TransitionCallbackReturn.SUCCESS

    def __change_state(self, transition: int | str) -> TransitionCallbackReturn:
        machine = self._state_machine
        number, label = machine.current_state
        before = LifecycleState(label, number)
        if isinstance(transition, str):
            machine.trigger_transition_by_label(transition)
        else:
            machine.trigger_transition_by_id(transition)
        result = self.__run_callback(before)
        machine.trigger_transition_by_label(result.to_label())
        if result is TransitionCallbackReturn.ERROR:
            machine.trigger_transition_by_label(self.__run_callback(before).to_label())
        return result

    def __run_callback(self, before: LifecycleState) -> TransitionCallbackReturn:
        """Run the callback of the current transition state. An exception in it is logged and is an error."""
        name = _CALLBACKS[self._state_machine.current_state[0]]
        try:
            result = getattr(self, name)(before)
        except Exception:  # noqa: BLE001 - the callback is the user's code
            self.__node.get_logger().error(f"{name} failed:\n{traceback.format_exc()}")
            return TransitionCallbackReturn.ERROR
        if not isinstance(result, TransitionCallbackReturn):
            self.__node.get_logger().error(f"{name} must return a TransitionCallbackReturn, but returned {result!r}")
            return TransitionCallbackReturn.ERROR
        return result

    def __serve(self, group: CallbackGroup | None) -> None:
        node = self.__node
        self.__events = node.create_publisher(TransitionEvent, "~/transition_event", 10)
        callbacks: dict[str, tuple[Any, Callable[[Any, Any], Any]]] = {
            "change_state": (ChangeState, self.__on_change_state),
            "get_state": (GetState, self.__on_get_state),
            "get_available_states": (GetAvailableStates, self.__on_get_available_states),
            "get_available_transitions": (GetAvailableTransitions, self.__on_get_available_transitions),
            "get_transition_graph": (GetAvailableTransitions, self.__on_get_transition_graph),
        }
        for name, (srv_type, callback) in callbacks.items():
            node.create_service(srv_type, f"~/{name}", callback, callback_group=group)

    def __on_change_state(self, request: Any, response: Any) -> Any:
        transition = request.transition.label or request.transition.id
        try:
            response.success = self.__change_state(transition) is TransitionCallbackReturn.SUCCESS
        except RCLError as error:
            hint = getattr(error, "hint", "")
            self.__node.get_logger().warning(f"The state was not changed: {hint}", throttle_duration_sec=1.0)
            response.success = False
        return response

    def __on_get_state(self, _: Any, response: Any) -> Any:
        response.current_state = _state(self._state_machine.current_state[0])
        return response

    def __on_get_available_states(self, _: Any, response: Any) -> Any:
        response.available_states = [_state(number) for number, _ in self._state_machine.available_states]
        return response

    def __on_get_available_transitions(self, _: Any, response: Any) -> Any:
        response.available_transitions = [_description(edge) for edge in self._state_machine.available_transitions]
        return response

    def __on_get_transition_graph(self, _: Any, response: Any) -> Any:
        response.available_transitions = [_description(edge) for edge in self._state_machine.transition_graph]
        return response

    def __publish_event(self, edge: Edge) -> None:
        if self.__events is None:
            return
        now = self.__node.get_clock().now()
        event: Any = TransitionEvent(start_state=_state(edge.start), goal_state=_state(edge.goal))
        if hasattr(event, "stamp"):  # from Lyrical on
            event.stamp = now.to_msg()
        else:
            event.timestamp = now.nanoseconds
        event.transition = Transition(id=edge.transition, label=edge.label)
        self.__events.publish(event)


class LifecycleNode(LifecycleNodeMixin, Node):
    """A node with a lifecycle.

    Args:
        node_name: Name of the node.
        enable_communication_interface: Whether other programs can read and change the state.
        **kwargs: The other arguments of `rclpy.node.Node`.
    """

    def __init__(self, node_name: str, *, enable_communication_interface: bool = True, **kwargs: Any) -> None:
        Node.__init__(self, node_name, **kwargs)
        LifecycleNodeMixin.__init__(self, enable_communication_interface=enable_communication_interface)


def _state(number: int) -> StateMsg:
    return StateMsg(id=number, label=STATES[number])


def _description(edge: Edge) -> TransitionDescription:
    return TransitionDescription(
        transition=Transition(id=edge.transition, label=edge.label),
        start_state=_state(edge.start),
        goal_state=_state(edge.goal),
    )


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
