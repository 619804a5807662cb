# SPDX-License-Identifier: Apache-2.0
"""Publishers, subscriptions, service clients and services of nodes."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.wire.rtps.clients import client_user_data
from rclpy._entity_registry import EntityRegistry, check_callback
from rclpy._node_graph import NodeGraph
from rclpy._node_parameters import NodeParameters
from rclpy.client import Client
from rclpy.event_handler import MismatchReporter, PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, as_qos_profile, qos_profile_services_default
from rclpy.qos_overriding_options import QoSOverridingOptions, apply_qos_overrides
from rclpy.service import Service
from rclpy.service_introspection import EVENT_TOPIC, ServiceEvents
from rclpy.subscription import Subscription
from rclpy.type_support import check_is_valid_srv_type, message_class

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.wire.endpoints import Publisher as WirePublisher
    from rclpy._remapping import NameResolver
    from rclpy.callback_groups import CallbackGroup
    from rclpy.executors import Executor
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from rclpy.subscription_content_filter_options import ContentFilterOptions


class Node(NodeParameters, NodeGraph):
    """The part of `rclpy.node.Node` that communicates over the graph. It has that name because errors contain it.

    Attributes:
        executor: The executor of the node.
        _Coframe__entities: The entities of the node, to which tf2_ros also adds its own.
        _Coframe__names: Expands and remaps names.
    """

    executor: Executor | None
    _Coframe__entities: EntityRegistry
    _Coframe__names: NameResolver
    _Coframe__client_class: type[Client] = Client

    def get_logger(self) -> RcutilsLogger:
        """Return the logger of the node."""
        raise TypeError(f"{type(self).__name__} has no logger")

    @property
    def publishers(self) -> Iterator[Publisher]:
        """The publishers of the node."""
        yield from self._Coframe__entities.of(Publisher)

    @property
    def subscriptions(self) -> Iterator[Subscription]:
        """The subscriptions of the node."""
        yield from self._Coframe__entities.of(Subscription)

    @property
    def clients(self) -> Iterator[Client]:
        """The service clients of the node."""
        yield from self._Coframe__entities.of(Client)

    @property
    def services(self) -> Iterator[Service]:
        """The services of the node."""
        yield from self._Coframe__entities.of(Service)

    def create_publisher(
        self,
        msg_type: type[Any],
        topic: str,
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: PublisherEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        publisher_class: type[Publisher] = Publisher,
    ) -> Publisher:
        """Create a publisher.

        Args:
            msg_type: Class of the messages.
            topic: Name of the topic, which is expanded and remapped.
            qos_profile: QoS profile, or its depth.
            callback_group: Group of the event callbacks. None: the default group of the node.
            event_callbacks: Callbacks for QoS events. None: incompatible QoS is logged.
            qos_overriding_options: QoS policies that parameters may override. None: no policies.
            publisher_class: Class of the publisher, a subclass of Publisher.

        Raises:
            InvalidQosOverridesError: A parameter value is not valid for its policy.
            InvalidTopicNameException: The topic name is not valid.
            AttributeError, RuntimeError: `msg_type` is not a message class.
            RCLError: The context was shut down.
        """
        name = self._Coframe__names.resolve(topic)
        msg_type, qos = message_class(msg_type), as_qos_profile(qos_profile)
        self._Coframe__entities.check_usable("publisher")
        if qos_overriding_options is not None:
            qos = apply_qos_overrides(self, "publisher", name, qos, qos_overriding_options)
        callbacks = event_callbacks or PublisherEventCallbacks()
        reporter = MismatchReporter(callbacks, self.get_logger(), topic)
        wire = self._Coframe__participant.publisher(
            self._Coframe__graph_node,
            name,
            msg_type,
            qos._Coframe__to_wire(),
            on_change=None if event_callbacks is None else self.context._Coframe__wakeup.event,
            on_mismatch=reporter,
        )
        handlers = callbacks.create_event_handlers(self._Coframe__entities.group(callback_group), wire, topic)
        publisher = publisher_class(wire, msg_type, topic, name, qos, self.context, event_handlers=handlers)
        return self._Coframe__entities.add_with_events(publisher, handlers, reporter)

    def create_subscription(
        self,
        msg_type: type[Any],
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
        content_filter_options: ContentFilterOptions | None = None,
    ) -> Subscription:
        """Create a subscription.

        Args:
            msg_type: Class of the messages.
            topic: Name of the topic, which is expanded and remapped.
            callback: Function or coroutine function that is called with each message, and with a dict of its timestamps
                (nanoseconds) if it accepts two arguments.
            qos_profile: QoS profile, or the number of messages that are queued for the executor.
            callback_group: Group of the callback. None: the default group of the node.
            event_callbacks: Callbacks for QoS events. None: incompatible QoS is logged.
            qos_overriding_options: QoS policies that parameters may override. None: no policies.
            raw: Whether to pass serialized messages to the callback.
            content_filter_options: Condition that messages must meet, which is evaluated here, not by the publishers.
                None: all messages.

        Raises:
            InvalidQosOverridesError: A parameter value is not valid for its policy.
            InvalidTopicNameException: The topic name is not valid.
            AttributeError, RuntimeError: `msg_type` is not a message class.
            RCLError: The context was shut down, or the condition of the content filter is invalid.
        """
        name = self._Coframe__names.resolve(topic)
        msg_type, qos = message_class(msg_type), as_qos_profile(qos_profile)
        check_callback(callback)
        self._Coframe__entities.check_usable("subscription")
        if qos_overriding_options is not None:
            qos = apply_qos_overrides(self, "subscription", name, qos, qos_overriding_options)
        callbacks = event_callbacks or SubscriptionEventCallbacks()
        reporter = MismatchReporter(callbacks, self.get_logger(), topic)
        wire = self._Coframe__participant.subscription(
            self._Coframe__graph_node,
            name,
            msg_type,
            qos._Coframe__to_wire(),
            on_data=self.context._Coframe__wakeup.event,
            on_mismatch=reporter,
        )
        group = self._Coframe__entities.group(callback_group)
        handlers = callbacks.create_event_handlers(group, wire, topic)
        subscription = Subscription(wire, msg_type, topic, name, callback, group, qos, raw, event_handlers=handlers)
        if content_filter_options is not None:
            subscription.set_content_filter(*content_filter_options)
        return self._Coframe__entities.add_with_events(subscription, handlers, reporter)

    def create_client(
        self,
        srv_type: Any,
        srv_name: str,
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Client:
        """Create a service client.

        Args:
            srv_type: Class of the service.
            srv_name: Name of the service, which is expanded and remapped.
            qos_profile: QoS profile of requests and responses.
            callback_group: Group of the client. None: the default group of the node.

        Raises:
            InvalidServiceNameException: The service name is not valid.
            AttributeError, RuntimeError: `srv_type` is not a service class.
            RCLError: The context was shut down.
        """
        check_is_valid_srv_type(srv_type)
        self._Coframe__entities.check_usable("client")
        name, qos, graph_node = (
            self._Coframe__names.resolve(srv_name, is_service=True),
            qos_profile._Coframe__to_wire(),
            self._Coframe__graph_node,
        )
        wakeup, identity = self.context._Coframe__wakeup.event, client_user_data()
        replies = self._Coframe__participant.service_subscription(
            graph_node, name, srv_type.Response, qos, "reply", wakeup, user_data=identity
        )
        requests = self._Coframe__participant.service_publisher(
            graph_node, name, srv_type.Request, qos, "request", user_data=identity
        )
        group = self._Coframe__entities.group(callback_group)
        return self._Coframe__entities.add(
            self._Coframe__client_class(
                self.context,
                self._Coframe__participant,
                requests,
                replies,
                lambda: self.executor,
                srv_type,
                srv_name,
                name,
                qos_profile,
                group,
                self.__service_events(srv_type, name),
            )
        )

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Service:
        """Create a service.

        Args:
            srv_type: Class of the service.
            srv_name: Name of the service, which is expanded and remapped.
            callback: Function or coroutine function that is called with the request and an empty response, and returns
                the response.
            qos_profile: QoS profile of requests and responses.
            callback_group: Group of the callback. None: the default group of the node.

        Raises:
            InvalidServiceNameException: The service name is not valid.
            AttributeError, RuntimeError: `srv_type` is not a service class.
            RCLError: The context was shut down.
        """
        return self._Coframe__create_service(Service, srv_type, srv_name, callback, qos_profile, callback_group)

    def _Coframe__create_service(
        self,
        kind: type[Service],
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        qos_profile: QoSProfile,
        callback_group: CallbackGroup | None,
    ) -> Service:
        check_is_valid_srv_type(srv_type)
        check_callback(callback)
        self._Coframe__entities.check_usable("service")
        name, qos, graph_node = (
            self._Coframe__names.resolve(srv_name, is_service=True),
            qos_profile._Coframe__to_wire(),
            self._Coframe__graph_node,
        )
        wakeup = self.context._Coframe__wakeup.event
        # The reply publisher comes first, so that clients that discover the request reader can receive replies.
        replies = self._Coframe__participant.service_publisher(graph_node, name, srv_type.Response, qos, "reply")
        requests = self._Coframe__participant.service_subscription(
            graph_node, name, srv_type.Request, qos, "request", wakeup
        )
        group = self._Coframe__entities.group(callback_group)
        events = self.__service_events(srv_type, name)
        return self._Coframe__entities.add(
            kind(requests, replies, srv_type, srv_name, name, callback, group, qos_profile, events)
        )

    def __service_events(self, srv_type: Any, service_name: str) -> ServiceEvents:
        def create_publisher(event_type: Any, qos: QoSProfile) -> WirePublisher:
            return self._Coframe__participant.publisher(
                self._Coframe__graph_node, service_name + EVENT_TOPIC, event_type, qos._Coframe__to_wire()
            )

        return ServiceEvents(srv_type, create_publisher)

    def destroy_publisher(self, publisher: Publisher) -> bool:
        """Destroy a publisher. Return False if it does not belong to this node."""
        return self._Coframe__entities.remove(publisher)

    def destroy_subscription(self, subscription: Subscription) -> bool:
        """Destroy a subscription. Return False if it does not belong to this node."""
        return self._Coframe__entities.remove(subscription)

    def destroy_client(self, client: Client) -> bool:
        """Destroy a service client. Return False if it does not belong to this node."""
        return self._Coframe__entities.remove(client)

    def destroy_service(self, service: Service) -> bool:
        """Destroy a service. Return False if it does not belong to this node."""
        return self._Coframe__entities.remove(service)
