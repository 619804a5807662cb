# SPDX-License-Identifier: Apache-2.0
"""Client of another node's parameters."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterEvent, ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    GetParameterTypes,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy import _absent
from rclpy.parameter import Parameter, parameter_dict_from_yaml_file
from rclpy.qos import QoSProfile, qos_profile_parameter_events, qos_profile_services_default

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.callback_groups import CallbackGroup
    from rclpy.client import Client
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.node import Node
    from rclpy.qos_overriding_options import QoSOverridingOptions
    from rclpy.subscription import Subscription
    from rclpy.task import Future

__all__ = ["AsyncParameterClient"]


class AsyncParameterClient:
    """Client that gets and sets the parameters of another node. The node must be spinning for the futures to complete.

    All requests return a future of the service's response, with the same exceptions as for `Client.call_async`, and
    call an optional callback with the future.

    Args:
        node: Node of the client.
        remote_node_name: Name of the node whose parameters are used, relative to the namespace of `node`.
        qos_profile: QoS profile of the service clients.
        callback_group: Group of the service clients. None: the default group of the node.
    """

    def __init__(
        self,
        node: Node,
        remote_node_name: str,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> None:
        self.remote_node_name = remote_node_name
        self.node = node
        self.__clients: dict[Any, Client] = {
            srv_type: node.create_client(
                srv_type, f"{remote_node_name}/{name}", qos_profile=qos_profile, callback_group=callback_group
            )
            for srv_type, name in (
                (GetParameters, "get_parameters"),
                (SetParameters, "set_parameters"),
                (SetParametersAtomically, "set_parameters_atomically"),
                (ListParameters, "list_parameters"),
                (DescribeParameters, "describe_parameters"),
                (GetParameterTypes, "get_parameter_types"),
            )
        }

    def services_are_ready(self) -> bool:
        """Return whether all parameter services of the node are available."""
        return all(client.service_is_ready() for client in self.__clients.values())

    def wait_for_services(self, timeout_sec: float | None = None) -> bool:
        """Wait until all parameter services of the node are available.

        Args:
            timeout_sec: Maximum time to wait in seconds. None: no limit.

        Returns:
            Whether they are available.
        """
        deadline = None if timeout_sec is None else time.monotonic() + timeout_sec
        for client in self.__clients.values():
            remaining = None if deadline is None else max(0.0, deadline - time.monotonic())
            if not client.wait_for_service(timeout_sec=remaining):
                return False
        return True

    def list_parameters(
        self,
        prefixes: Sequence[str] | None = None,
        depth: int | None = None,
        callback: Callable[[Future[Any]], None] | None = None,
    ) -> Future[Any]:
        """Request the names of the parameters.

        Args:
            prefixes: Prefixes of the names. None for all parameters.
            depth: Number of levels below a prefix. None for all levels.
            callback: Function that is called with the completed future.
        """
        request = ListParameters.Request(
            prefixes=list(prefixes or []), depth=ListParameters.Request.DEPTH_RECURSIVE if depth is None else depth
        )
        return self.__send(ListParameters, request, callback)

    def get_parameters(
        self, names: Sequence[str], callback: Callable[[Future[Any]], None] | None = None
    ) -> Future[Any]:
        """Request the values of parameters."""
        return self.__send(GetParameters, GetParameters.Request(names=list(names)), callback)

    def set_parameters(
        self,
        parameters: Sequence[Parameter[Any] | ParameterMsg],
        callback: Callable[[Future[Any]], None] | None = None,
    ) -> Future[Any]:
        """Request that parameters are set one after another."""
        return self.__send(SetParameters, SetParameters.Request(parameters=_messages(parameters)), callback)

    def set_parameters_atomically(
        self,
        parameters: Sequence[Parameter[Any] | ParameterMsg],
        callback: Callable[[Future[Any]], None] | None = None,
    ) -> Future[Any]:
        """Request that all parameters are set, or no parameter if one is rejected."""
        request = SetParametersAtomically.Request(parameters=_messages(parameters))
        return self.__send(SetParametersAtomically, request, callback)

    def describe_parameters(
        self, names: Sequence[str], callback: Callable[[Future[Any]], None] | None = None
    ) -> Future[Any]:
        """Request the descriptors of parameters."""
        return self.__send(DescribeParameters, DescribeParameters.Request(names=list(names)), callback)

    def get_parameter_types(
        self, names: Sequence[str], callback: Callable[[Future[Any]], None] | None = None
    ) -> Future[Any]:
        """Request the types of parameters."""
        return self.__send(GetParameterTypes, GetParameterTypes.Request(names=list(names)), callback)

    def delete_parameters(
        self, names: Sequence[str], callback: Callable[[Future[Any]], None] | None = None
    ) -> Future[Any]:
        """Request that parameters are deleted, which their node allows only for dynamically typed ones."""
        return self.set_parameters([ParameterMsg(name=name, value=ParameterValue()) for name in names], callback)

    def load_parameter_file(
        self, parameter_file: str, use_wildcard: bool = False, callback: Callable[[Future[Any]], None] | None = None
    ) -> Future[Any]:
        """Request that the parameters of a YAML file are set.

        Args:
            parameter_file: Path of the file.
            use_wildcard: Whether to include the parameters of all nodes (`/**`).
            callback: Function that is called with the completed future.

        Raises:
            RuntimeError: The file does not exist or has no parameters for the node.
        """
        return self.set_parameters(self.__read(parameter_file, use_wildcard=use_wildcard), callback)

    def load_parameter_file_atomically(
        self, parameter_file: str, use_wildcard: bool = False, callback: Callable[[Future[Any]], None] | None = None
    ) -> Future[Any]:
        """Request that all parameters of a YAML file are set, or none. See `load_parameter_file`."""
        return self.set_parameters_atomically(self.__read(parameter_file, use_wildcard=use_wildcard), callback)

    @staticmethod
    def on_parameter_event(
        node: Node,
        callback: Callable[[ParameterEvent], None],
        qos_profile: QoSProfile = qos_profile_parameter_events,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> Subscription:
        """Call a function for the changes of the parameters of all nodes.

        Args:
            node: Node of the subscription.
            callback: Function that is called with each event.
            qos_profile: QoS profile of the subscription.
            callback_group: Group of the callback. None: the default group of the node.
            event_callbacks: Callbacks for QoS events of the subscription.
            qos_overriding_options: The QoS policies that parameters may override.
            raw: Whether the callback receives the serialized bytes.

        Returns:
            The subscription to `/parameter_events`.
        """
        return node.create_subscription(
            ParameterEvent,
            "/parameter_events",
            callback,
            qos_profile,
            callback_group=callback_group,
            event_callbacks=event_callbacks,
            qos_overriding_options=qos_overriding_options,
            raw=raw,
        )

    def __read(self, parameter_file: str, *, use_wildcard: bool) -> list[ParameterMsg]:
        nodes = [self.remote_node_name]
        return list(parameter_dict_from_yaml_file(parameter_file, use_wildcard, target_nodes=nodes).values())

    def __send(self, srv_type: Any, request: Any, callback: Callable[[Future[Any]], None] | None) -> Future[Any]:
        future = self.__clients[srv_type].call_async(request)
        if callback is not None:
            future.add_done_callback(callback)
        return future


def _messages(parameters: Sequence[Parameter[Any] | ParameterMsg]) -> list[ParameterMsg]:
    return [parameter.to_parameter_msg() if isinstance(parameter, Parameter) else parameter for parameter in parameters]


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
