# SPDX-License-Identifier: Apache-2.0
"""Nodes."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import threading
import weakref
from typing import TYPE_CHECKING, Any, TypeVar

from rcl_interfaces.msg import ParameterEvent
from rclpy import _arguments
from rclpy._absent import Handle, no_handle
from rclpy._arguments import Arguments
from rclpy._destroyable import destroyed
from rclpy._node_graph import NodeGraph
from rclpy._node_parameters import NodeParameters
from rclpy._remapping import NameResolver, remap_node
from rclpy._rosout import RosoutPublisher
from rclpy.callback_groups import CallbackGroup, MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.client import Client
from rclpy.clock import Clock, ROSClock
from rclpy.constants import S_TO_NS
from rclpy.event_handler import EventHandler, MismatchReporter, PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.exceptions import NameValidationException, NotInitializedException, RCLError, _with_hint
from rclpy.guard_condition import GuardCondition
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.parameter import Parameter
from rclpy.parameter_service import ParameterService
from rclpy.publisher import Publisher
from rclpy.qos import (
    QoSProfile,
    as_qos_profile,
    qos_profile_parameter_events,
    qos_profile_services_default,
)
from rclpy.qos_overriding_options import QoSOverridingOptions, apply_qos_overrides
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.time_source import USE_SIM_TIME_NAME, TimeSource
from rclpy.timer import Rate, Timer
from rclpy.type_support import check_is_valid_srv_type, message_class
from rclpy.utilities import get_default_context
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name
from rclpy.waitable import Waitable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from typing_extensions import Self

    from rclpy.context import Context
    from rclpy.executors import Executor, ExecutorEntity, PolledSubscription
    from rclpy.subscription_content_filter_options import ContentFilterOptions

HIDDEN_NODE_PREFIX = "_"
EntityT = TypeVar("EntityT")


class Node(NodeParameters, NodeGraph):
    """A node of the ROS graph.

    Args:
        node_name: Name of the node. `--ros-args -r __node:=` overrides it.
        context: Context of the node. None: the default context.
        cli_args: Command line with `--ros-args` for this node, which takes precedence over that of the process.
        namespace: Namespace of the node. `--ros-args -r __ns:=` overrides it.
        use_global_arguments: Whether the command line of the process applies to the node.
        enable_rosout: Whether to publish log messages on /rosout.
        start_parameter_services: Whether other nodes can get and set the parameters (`ros2 param`).
        parameter_overrides: Values that override the declared defaults and the command line.
        allow_undeclared_parameters: Whether undeclared parameters may be used.
        automatically_declare_parameters_from_overrides: Whether to declare all parameter overrides.
        enable_logger_service: Whether other nodes can get and set the log levels.

    Raises:
        NotInitializedException: The context is not initialized or was shut down.
        InvalidNodeNameException: The name is not valid.
        InvalidNamespaceException: The namespace is not valid.
    """

    handle = Handle()

    def __init__(
        self,
        node_name: str,
        *,
        context: Context | None = None,
        cli_args: list[str] | None = None,
        namespace: str | None = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        start_parameter_services: bool = True,
        parameter_overrides: list[Parameter[Any]] | None = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None:
        self.__context = context or get_default_context()
        if not self.__context.ok():
            raise NotInitializedException("cannot create node")
        arguments = _arguments_for(self.__context, cli_args, use_global_arguments=use_global_arguments)
        self.__names = _names_for(node_name, namespace or "", arguments)
        self.__lock = threading.RLock()
        self.__is_destroyed = False
        self.__executor: Callable[[], Executor | None] = _no_executor
        self.__entities: dict[type[Any], list[Any]] = {
            kind: [] for kind in (Timer, Subscription, GuardCondition, Client, Service, Waitable, Publisher, Rate)
        }
        self.__waitables: tuple[ExecutorEntity, ...] = ()
        self.__timers_of_rates: dict[Rate, Timer] = {}
        self.__default_callback_group = MutuallyExclusiveCallbackGroup()
        self.__logger = RcutilsLogger(self.get_fully_qualified_name().lstrip("/").replace("/", "."))
        self.__clock = ROSClock()

        overrides = {
            override.name: Parameter(override.name, value=override.value)
            for override in arguments.parameters
            if override.matches(self.get_fully_qualified_name())
        }
        overrides.update((parameter.name, parameter) for parameter in parameter_overrides or [])

        self._Coframe__participant = self.__context._Coframe__get_participant()
        self._Coframe__graph_node = self._Coframe__participant.add_node(
            self.__names.namespace, self.__names.node_name, has_parameters=True
        )
        self._Coframe__polled_subscriptions: list[PolledSubscription] = []
        self.__rosout: RosoutPublisher | None = None
        if enable_rosout and arguments.logging.rosout:
            self.__rosout = RosoutPublisher(self._Coframe__participant, self._Coframe__graph_node, self.__logger.name)
        self.__time_source = TimeSource(node=self)
        self.__time_source.attach_clock(self.__clock)
        try:
            self.__parameter_events = self.create_publisher(
                ParameterEvent, "/parameter_events", qos_profile_parameter_events
            )
            NodeParameters.__init__(
                self,
                overrides,
                allow_undeclared=allow_undeclared_parameters,
                declare_overrides=automatically_declare_parameters_from_overrides,
            )
            if not self.has_parameter(USE_SIM_TIME_NAME):
                self.declare_parameter(USE_SIM_TIME_NAME, False)
            if start_parameter_services:
                ParameterService(self)
            if enable_logger_service:
                from rclpy.logging_service import LoggingService  # noqa: PLC0415 - few nodes have it

                LoggingService(self)
        except BaseException:
            self.destroy_node()  # The caller has no reference to the node.
            raise

    if not TYPE_CHECKING:  # With `__getattr__`, type checkers would accept every misspelled attribute.

        def __getattr__(self, name: str) -> Any:
            if name == "handle":  # The error of the property ends here as well.
                raise no_handle(type(self))
            if name.startswith(("_Node__", "_NodeParameters__", "_Coframe__")):
                raise AttributeError(
                    f"The node {type(self).__name__} is not initialized. "
                    "Call super().__init__('node_name') first in its __init__."
                )
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    # Names

    def get_name(self) -> str:
        """Return the name without the namespace."""
        return self.__names.node_name

    def get_namespace(self) -> str:
        """Return the namespace, for example "/" or "/robot1"."""
        return self.__names.namespace

    def get_fully_qualified_name(self) -> str:
        """Return the name with the namespace, for example "/robot1/arm"."""
        return f"{self.get_namespace().rstrip('/')}/{self.get_name()}"

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a topic, remapped unless `only_expand` is set.

        Raises:
            RCLError: The name is not valid.
        """
        return self.__resolve(topic, is_service=False, only_expand=only_expand)

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a service, remapped unless `only_expand` is set.

        Raises:
            RCLError: The name is not valid.
        """
        return self.__resolve(service, is_service=True, only_expand=only_expand)

    def __resolve(self, name: str, *, is_service: bool, only_expand: bool) -> str:
        try:
            return self.__names.resolve(name, is_service=is_service, only_expand=only_expand)
        except NameValidationException as error:
            raise _with_hint(RCLError(f"failed to resolve name: {error.error_msg}"), f"The name is {name!r}.") from None

    # Properties

    @property
    def context(self) -> Context:
        """The context of the node."""
        return self.__context

    @property
    def default_callback_group(self) -> CallbackGroup:
        """The callback group of entities created without a group. It is mutually exclusive."""
        return self.__default_callback_group

    @property
    def executor(self) -> Executor | None:
        """The executor of the node. Setting it adds the node to the executor."""
        return self.__executor()

    @executor.setter
    def executor(self, new_executor: Executor | None) -> None:
        current = self.executor
        if current is new_executor:
            return
        self.__executor = _no_executor if new_executor is None else weakref.ref(new_executor)
        if current is not None:
            current.remove_node(self)
        if new_executor is not None:
            new_executor.add_node(self)

    @property
    def publishers(self) -> Iterator[Publisher]:
        """The publishers of the node."""
        yield from self.__entities[Publisher]

    @property
    def subscriptions(self) -> Iterator[Subscription]:
        """The subscriptions of the node."""
        yield from self.__entities[Subscription]

    @property
    def clients(self) -> Iterator[Client]:
        """The service clients of the node."""
        yield from self.__entities[Client]

    @property
    def services(self) -> Iterator[Service]:
        """The services of the node."""
        yield from self.__entities[Service]

    @property
    def timers(self) -> Iterator[Timer]:
        """The timers of the node."""
        yield from self.__entities[Timer]

    @property
    def guards(self) -> Iterator[GuardCondition]:
        """The guard conditions of the node."""
        yield from self.__entities[GuardCondition]

    def get_clock(self) -> Clock:
        """Return the clock of the node, which is set from /clock if `use_sim_time` is true."""
        return self.__clock

    def get_logger(self) -> RcutilsLogger:
        """Return the logger of the node."""
        return self.__logger

    # Creation and destruction of entities

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
        name = self.__names.resolve(topic)
        msg_type, qos = message_class(msg_type), as_qos_profile(qos_profile)
        self.__check_usable("publisher")
        if qos_overriding_options is not None:
            qos = apply_qos_overrides(self, "publisher", name, qos, qos_overriding_options)
        callbacks = event_callbacks or PublisherEventCallbacks()
        reporter = MismatchReporter(callbacks, self.__logger, topic)
        wire = self._Coframe__participant.publisher(
            self._Coframe__graph_node,
            name,
            msg_type,
            qos._Coframe__to_wire(),
            on_change=None if event_callbacks is None else self.context._Coframe__wakeup.event,
            on_mismatch=reporter,
        )
        handlers = callbacks.create_event_handlers(self.__group(callback_group), wire, topic)
        publisher = publisher_class(wire, msg_type, topic, name, qos, self.context, event_handlers=handlers)
        return self.__add_with_events(publisher, handlers, reporter)

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
            content_filter_options: None, because coframe has no content filters.

        Raises:
            InvalidQosOverridesError: A parameter value is not valid for its policy.
            InvalidTopicNameException: The topic name is not valid.
            AttributeError, RuntimeError: `msg_type` is not a message class.
            RCLError: The context was shut down.
            NotImplementedError: Options of a content filter are given.
        """
        if content_filter_options is not None:
            raise NotImplementedError(
                f"coframe has no content filters ({content_filter_options.filter_expression!r}). Skip the messages in "
                "the callback instead."
            )
        name = self.__names.resolve(topic)
        msg_type, qos = message_class(msg_type), as_qos_profile(qos_profile)
        _check_callback(callback)
        self.__check_usable("subscription")
        if qos_overriding_options is not None:
            qos = apply_qos_overrides(self, "subscription", name, qos, qos_overriding_options)
        callbacks = event_callbacks or SubscriptionEventCallbacks()
        reporter = MismatchReporter(callbacks, self.__logger, topic)
        wire = self._Coframe__participant.subscription(
            self._Coframe__graph_node,
            name,
            msg_type,
            qos._Coframe__to_wire(),
            on_data=self.context._Coframe__wakeup.event,
            on_mismatch=reporter,
        )
        group = self.__group(callback_group)
        handlers = callbacks.create_event_handlers(group, wire, topic)
        subscription = Subscription(wire, msg_type, topic, name, callback, group, qos, raw, event_handlers=handlers)
        return self.__add_with_events(subscription, handlers, reporter)

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
        self.__check_usable("client")
        name, qos, graph_node = (
            self.__names.resolve(srv_name, is_service=True),
            qos_profile._Coframe__to_wire(),
            self._Coframe__graph_node,
        )
        wakeup = self.context._Coframe__wakeup.event
        replies = self._Coframe__participant.subscription(
            graph_node, name, srv_type.Response, qos, on_data=wakeup, kind="reply"
        )
        requests = self._Coframe__participant.publisher(graph_node, name, srv_type.Request, qos, kind="request")
        group = self.__group(callback_group)
        return self.__add(
            Client(
                self.context,
                self._Coframe__participant,
                requests,
                replies,
                self.__get_executor,
                srv_type,
                srv_name,
                name,
                qos_profile,
                group,
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
        _check_callback(callback)
        self.__check_usable("service")
        name, qos, graph_node = (
            self.__names.resolve(srv_name, is_service=True),
            qos_profile._Coframe__to_wire(),
            self._Coframe__graph_node,
        )
        wakeup = self.context._Coframe__wakeup.event
        # The reply publisher comes first, so that clients that discover the request reader can receive replies.
        replies = self._Coframe__participant.publisher(graph_node, name, srv_type.Response, qos, kind="reply")
        requests = self._Coframe__participant.subscription(
            graph_node, name, srv_type.Request, qos, on_data=wakeup, kind="request"
        )
        group = self.__group(callback_group)
        return self.__add(kind(requests, replies, srv_type, srv_name, name, callback, group, qos_profile))

    def create_timer(
        self,
        timer_period_sec: float,
        callback: Callable[[], Any],
        callback_group: CallbackGroup | None = None,
        clock: Clock | None = None,
        autostart: bool = True,
    ) -> Timer:
        """Create a timer.

        Args:
            timer_period_sec: Period in seconds.
            callback: Function or coroutine function that is called without arguments.
            callback_group: Group of the callback. None: the default group of the node.
            clock: Clock that measures the period. None: the clock of the node.
            autostart: Whether the timer starts now, and not with its `reset()`.
        """
        _check_callback(callback)
        self.__check_usable("timer")
        period_ns = int(float(timer_period_sec) * S_TO_NS)
        group = self.__group(callback_group)
        timer = Timer(callback, group, period_ns, clock or self.__clock, context=self.context)
        if not autostart:
            timer.cancel()
        return self.__add(timer)

    def create_guard_condition(
        self, callback: Callable[[], Any], callback_group: CallbackGroup | None = None
    ) -> GuardCondition:
        """Create a guard condition.

        Args:
            callback: Function or coroutine function that is called after a trigger.
            callback_group: Group of the callback. None: the default group of the node.
        """
        self.__check_usable("guard_condition")
        return self.__add(GuardCondition(callback, self.__group(callback_group), context=self.context))

    def create_rate(self, frequency: float, clock: Clock | None = None) -> Rate:
        """Create a rate, whose `sleep()` limits a loop to a frequency.

        Args:
            frequency: Frequency in Hz.
            clock: Clock that measures the period. None: the clock of the node.

        Raises:
            ValueError: The frequency is not positive.
        """
        if frequency <= 0:
            raise ValueError("frequency must be > 0")
        self.__check_not_destroyed()
        # A group of its own, so that the callbacks of the node do not delay the end of a period.
        timer = self.create_timer(1 / frequency, _do_nothing, ReentrantCallbackGroup(), clock)
        rate = self.__add(Rate(timer, context=self.context))
        self.__timers_of_rates[rate] = timer
        return rate

    def add_waitable(self, waitable: Waitable) -> None:
        """Add a waitable of the user, which executors of this node run."""
        self.__check_not_destroyed()
        with self.__lock:
            self.__entities[Waitable].append(waitable)
            self.__collect_waitables()
        self.context._Coframe__wakeup.set()

    def remove_waitable(self, waitable: Waitable) -> None:
        """Remove a waitable.

        Raises:
            ValueError: The waitable was not added.
        """
        with self.__lock:
            self.__entities[Waitable].remove(waitable)
            self.__collect_waitables()

    @property
    def waitables(self) -> Iterator[Waitable]:
        """The waitables of the user, and the handlers of QoS events."""
        yield from self.__entities[Waitable]

    def destroy_publisher(self, publisher: Publisher) -> bool:
        """Destroy a publisher. Return False if it does not belong to this node."""
        return self.__remove(publisher)

    def destroy_subscription(self, subscription: Subscription) -> bool:
        """Destroy a subscription. Return False if it does not belong to this node."""
        return self.__remove(subscription)

    def destroy_client(self, client: Client) -> bool:
        """Destroy a service client. Return False if it does not belong to this node."""
        return self.__remove(client)

    def destroy_service(self, service: Service) -> bool:
        """Destroy a service. Return False if it does not belong to this node."""
        return self.__remove(service)

    def destroy_timer(self, timer: Timer) -> bool:
        """Destroy a timer. Return False if it does not belong to this node."""
        return self.__remove(timer)

    def destroy_guard_condition(self, guard: GuardCondition) -> bool:
        """Destroy a guard condition. Return False if it does not belong to this node."""
        return self.__remove(guard)

    def destroy_rate(self, rate: Rate) -> bool:
        """Destroy a rate. Return False if it does not belong to this node."""
        timer = self.__timers_of_rates.pop(rate, None)
        return self.__remove(rate) and timer is not None and self.__remove(timer)

    def destroy_node(self) -> None:
        """Destroy all entities of the node and remove it from the graph. Repeated calls have no effect."""
        with self.__lock:
            if self.__is_destroyed:
                return
            self.__is_destroyed = True
        if self.executor is not None:
            self.executor.remove_node(self)
        self.__entities[Waitable].clear()  # The user destroys them.
        for entities in self.__entities.values():
            while entities:
                entities.pop().destroy()
        self.__waitables = ()
        if self.__rosout is not None:
            self.__rosout.close()
        self._Coframe__graph_node.close()
        self._Coframe__participant.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.destroy_node()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.get_fully_qualified_name()}>"

    def _Coframe__add_entity(self, entity: EntityT) -> EntityT:
        """Add a publisher or subscription that tf2_ros created, so that the node lists and destroys it."""
        return self.__add(entity)

    @property
    def _Coframe__is_destroyed(self) -> bool:
        return self.__is_destroyed

    def _Coframe__waitables(self) -> tuple[ExecutorEntity, ...]:
        """Return the entities that an executor waits for."""
        return self.__waitables

    def _Coframe__on_parameter_set(self, parameter: Parameter[Any]) -> None:
        if parameter.name == USE_SIM_TIME_NAME:
            self.__time_source.ros_time_is_active = parameter.value is True

    def _Coframe__publish_parameter_event(self, event: ParameterEvent) -> None:
        event.node = self.get_fully_qualified_name()
        event.stamp = self.__clock.now().to_msg()
        self.__parameter_events.publish(event)

    def __get_executor(self) -> Executor | None:
        return self.executor

    def __check_not_destroyed(self) -> None:
        if self.__is_destroyed:
            raise destroyed(f"The node {self.get_fully_qualified_name()}")

    def __check_usable(self, entity: str) -> None:
        """Check that an entity can be created: the node exists, and its context was not shut down."""
        self.__check_not_destroyed()
        # After a signal, a program may still create publishers for final messages.
        if not (self.context.ok() or self.context._Coframe__was_shut_down_by_signal):
            reason = "Failed to create {}: rcl node's context is invalid"
            if entity in {"timer", "guard_condition"}:
                reason = (
                    "failed to create {}: the given context is not valid, either rcl_init() was not called or "
                    "rcl_shutdown() was called."
                )
            hint = "rclpy.shutdown() was called. Create a new node after rclpy.init()."
            raise _with_hint(RCLError(reason.format(entity)), hint)

    def __group(self, group: CallbackGroup | None) -> CallbackGroup:
        return self.__default_callback_group if group is None else group

    def __add(self, entity: EntityT) -> EntityT:
        with self.__lock:
            self.__entities_like(entity).append(entity)
            self.__collect_waitables()
        group = getattr(entity, "callback_group", None)
        if group is not None:
            group.add_entity(entity)
        self.context._Coframe__wakeup.set()
        return entity

    def __add_with_events(self, entity: EntityT, handlers: list[EventHandler], reporter: MismatchReporter) -> EntityT:
        reporter.handlers = handlers
        for handler in handlers:
            self.add_waitable(handler)
        return self.__add(entity)

    def __remove(self, entity: Any) -> bool:
        with self.__lock:
            entities = self.__entities_like(entity)
            if entity not in entities:
                return False
            entities.remove(entity)
            for handler in getattr(entity, "event_handlers", ()):
                self.__entities[Waitable].remove(handler)
            self.__collect_waitables()
        entity.destroy()
        return True

    def __entities_like(self, entity: Any) -> list[Any]:
        return next((entities for kind, entities in self.__entities.items() if isinstance(entity, kind)), [])

    def __collect_waitables(self) -> None:
        """Update the waitables. Executors read the tuple without a lock."""
        self.__waitables = tuple(
            entity
            for kind in (Timer, Subscription, GuardCondition, Client, Service, Waitable)
            for entity in self.__entities[kind]
        )


def _check_callback(callback: object) -> None:
    if not callable(callback):
        raise TypeError(f"The callback must be a function, not {callback!r}. Pass the function without calling it.")


def _do_nothing() -> None:
    """Do nothing at the end of a rate's period, except that `spin_once` returns."""


def _no_executor() -> None:
    return None


def _arguments_for(context: Context, cli_args: list[str] | None, *, use_global_arguments: bool) -> Arguments:
    """Return the arguments of the node, combined with those of the process, which have lower precedence."""
    shared = context._Coframe__arguments if use_global_arguments else Arguments()
    own = _arguments.parse(cli_args) if cli_args else Arguments()
    return Arguments(
        remaps=own.remaps + shared.remaps,
        # The last value of a parameter applies.
        parameters=shared.parameters + own.parameters,
        logging=shared.logging,
    )


def _names_for(node_name: str, namespace: str, arguments: Arguments) -> NameResolver:
    validate_node_name(node_name)
    if not namespace.startswith("/"):
        namespace = f"/{namespace}"
    node_name, namespace = remap_node(node_name, namespace, arguments.remaps)
    if not namespace.startswith("/"):
        namespace = f"/{namespace}"
    validate_node_name(node_name)
    validate_namespace(namespace)
    return NameResolver(node_name, namespace, arguments.remaps)
