# SPDX-License-Identifier: Apache-2.0
"""Callbacks for changes of the parameters of any node, from `/parameter_events`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING

from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterEvent
from rclpy import _absent
from rclpy.qos import QoSProfile, qos_profile_parameter_events

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.node import Node
    from rclpy.qos_overriding_options import QoSOverridingOptions

__all__ = ["ParameterCallbackHandle", "ParameterEventCallbackHandle", "ParameterEventHandler"]


@dataclass(eq=False)
class ParameterCallbackHandle:
    """Registration of a callback for one parameter of one node."""

    parameter_name: str
    node_name: str
    callback: Callable[[ParameterMsg], None]


@dataclass(eq=False)
class ParameterEventCallbackHandle:
    """Registration of a callback for all parameter events."""

    callback: Callable[[ParameterEvent], None]


class ParameterEventHandler:
    """Subscription to `/parameter_events` that calls back for new and changed parameters. The node must be spinning.

    Args:
        node: Node of the subscription.
        qos_profile: QoS profile of the subscription.
        callback_group: Group of the callbacks. None: the default group of the node.
        event_callbacks: Callbacks for QoS events of the subscription.
        qos_overriding_options: The QoS policies that parameters may override.
        raw: Whether the subscription receives serialized bytes, which this class then cannot examine.
    """

    def __init__(
        self,
        node: Node,
        qos_profile: QoSProfile = qos_profile_parameter_events,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> None:
        self.__node = node
        self.__parameter_callbacks: list[ParameterCallbackHandle] = []
        self.__event_callbacks: list[ParameterEventCallbackHandle] = []
        self.__node_names: set[str] = set()
        self.__subscription = node.create_subscription(
            ParameterEvent,
            "/parameter_events",
            self.__on_event,
            qos_profile,
            callback_group=callback_group,
            event_callbacks=event_callbacks,
            qos_overriding_options=qos_overriding_options,
            raw=raw,
        )

    def destroy(self) -> None:
        """Destroy the subscription."""
        self.__node.destroy_subscription(self.__subscription)

    def add_parameter_callback(
        self, parameter_name: str, node_name: str, callback: Callable[[ParameterMsg], None]
    ) -> ParameterCallbackHandle:
        """Add a callback for one parameter. The callback that was added last is called first.

        Args:
            parameter_name: Name of the parameter.
            node_name: Name of its node, relative to the namespace of this node. An empty string: this node.
            callback: Function that is called with the parameter as a `rcl_interfaces/Parameter`.
        """
        handle = ParameterCallbackHandle(parameter_name, self.__resolve(node_name), callback)
        self.__parameter_callbacks.insert(0, handle)
        return handle

    def remove_parameter_callback(self, handle: ParameterCallbackHandle) -> None:
        """Remove a callback.

        Raises:
            ValueError: The callback was not added, or was removed before.
        """
        self.__parameter_callbacks.remove(handle)

    def add_parameter_event_callback(self, callback: Callable[[ParameterEvent], None]) -> ParameterEventCallbackHandle:
        """Add a callback for all parameter events. The callback that was added last is called first."""
        handle = ParameterEventCallbackHandle(callback)
        self.__event_callbacks.insert(0, handle)
        return handle

    def remove_parameter_event_callback(self, handle: ParameterEventCallbackHandle) -> None:
        """Remove a callback.

        Raises:
            ValueError: The callback was not added, or was removed before.
        """
        self.__event_callbacks.remove(handle)

    def configure_nodes_filter(self, node_names: list[str] | None = None) -> bool:
        """Handle only the events of some nodes.

        Args:
            node_names: Names of the nodes, relative to the namespace of this node. None or empty: all nodes.

        Returns:
            True: the filter is always available.
        """
        self.__node_names = {self.__resolve(name) for name in node_names or []}
        return True

    @staticmethod
    def get_parameter_from_event(event: ParameterEvent, parameter_name: str, node_name: str) -> ParameterMsg | None:
        """Return a new or changed parameter of an event, or None if the event is about others.

        Args:
            event: The event to search.
            parameter_name: Name of the parameter.
            node_name: Fully qualified name of its node.
        """
        parameters = ParameterEventHandler.get_parameters_from_event(event) if event.node == node_name else []
        return next((parameter for parameter in parameters if parameter.name == parameter_name), None)

    @staticmethod
    def get_parameters_from_event(event: ParameterEvent) -> Iterable[ParameterMsg]:
        """Return the new and changed parameters of an event."""
        return list(chain(event.new_parameters, event.changed_parameters))

    def __on_event(self, event: ParameterEvent) -> None:
        if self.__node_names and event.node not in self.__node_names:
            return
        for handle in list(self.__parameter_callbacks):
            parameter = self.get_parameter_from_event(event, handle.parameter_name, handle.node_name)
            if parameter is not None:
                handle.callback(parameter)
        for event_handle in list(self.__event_callbacks):
            event_handle.callback(event)

    def __resolve(self, node_name: str) -> str:
        if not node_name:
            return self.__node.get_fully_qualified_name()
        return node_name if node_name.startswith("/") else f"{self.__node.get_namespace().rstrip('/')}/{node_name}"


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
