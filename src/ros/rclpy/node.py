"""Nodes."""

# The modules of rclpy share what its users do not see.
# ruff: noqa: SLF001

from __future__ import annotations

import threading
import weakref
from typing import TYPE_CHECKING, Any, TypeVar

from rclpy import _arguments
from rclpy._arguments import Arguments
from rclpy._node_graph import NodeGraph
from rclpy._node_parameters import NodeParameters
from rclpy._remapping import NameResolver, remap_node
from rclpy._rosout import RosoutPublisher
from rclpy.callback_groups import CallbackGroup, MutuallyExclusiveCallbackGroup
from rclpy.client import Client
from rclpy.clock import Clock, ROSClock
from rclpy.constants import S_TO_NS
from rclpy.exceptions import InvalidHandle, NotInitializedException
from rclpy.guard_condition import GuardCondition
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.parameter import Parameter
from rclpy.parameter_service import ParameterService
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, qos_from, qos_profile_services_default
from rclpy.qos_overriding_options import QoSOverridingOptions, overridden
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.time_source import USE_SIM_TIME_NAME, TimeSource
from rclpy.timer import Rate, Timer
from rclpy.type_support import check_is_valid_msg_type, check_is_valid_srv_type
from rclpy.utilities import get_default_context
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from typing_extensions import Self

    from rclpy.context import Context
    from rclpy.executors import Executable, Executor, SilentInput

EntityT = TypeVar("EntityT")


class Node(NodeParameters, NodeGraph):
    """A node of the ROS graph.

    Args:
        node_name: Its name; `--ros-args -r __node:=` wins over it.
        context: What it lives in; None: the default context.
        cli_args: A command line with `--ros-args` for this node, heard before the process's.
        namespace: Its namespace; `--ros-args -r __ns:=` wins over it.
        use_global_arguments: Whether the process's command line applies to it.
        enable_rosout: Whether its log messages also go to /rosout.
        start_parameter_services: Whether others may see and set its parameters (`ros2 param`).
        parameter_overrides: Values that win over the declared defaults and over the command line.
        allow_undeclared_parameters: Parameters need not be declared.
        automatically_declare_parameters_from_overrides: Declare all parameters of the command line at once.

    Raises:
        NotInitializedException: There was no `rclpy.init()`, or the context is shut down.
        InvalidNodeNameException: The name breaks the rules.
        InvalidNamespaceException: The namespace does.
    """

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
            kind: [] for kind in (Timer, Subscription, GuardCondition, Client, Service, Publisher, Rate)
        }
        self.__executables: tuple[Executable, ...] = ()
        self.__default_callback_group = MutuallyExclusiveCallbackGroup()
        self.__logger = RcutilsLogger(self.get_fully_qualified_name().lstrip("/").replace("/", "."))
        self.__clock = ROSClock()

        overrides = {
            override.name: Parameter(override.name, value=override.value)
            for override in arguments.parameters
            if override.fits(self.get_fully_qualified_name())
        }
        overrides.update((parameter.name, parameter) for parameter in parameter_overrides or [])

        self._wire = self.__context._join_graph()
        self._graph_node = self._wire.add_node(self.__names.namespace, self.__names.node_name)
        self._silent_inputs: list[SilentInput] = []
        self.__rosout: RosoutPublisher | None = None
        if enable_rosout and arguments.logging.rosout:
            self.__rosout = RosoutPublisher(self._wire, self._graph_node, self.__logger.name)
        self.__time_source = TimeSource(node=self)
        self.__time_source.attach_clock(self.__clock)
        try:
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
        except BaseException:
            self.destroy_node()  # nobody else could
            raise

    if not TYPE_CHECKING:  # a type checker would take every misspelt attribute for one of these

        def __getattr__(self, name: str) -> Any:
            if name.startswith(("_Node__", "_NodeParameters__")):
                raise AttributeError(
                    f"{type(self).__name__} is no node yet: its __init__ must call super().__init__('its_name') first"
                )
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    # Names

    def get_name(self) -> str:
        """Returns the name without the namespace."""
        return self.__names.node_name

    def get_namespace(self) -> str:
        """Returns the namespace, for example "/" or "/robot1"."""
        return self.__names.namespace

    def get_fully_qualified_name(self) -> str:
        """Returns the name with the namespace, for example "/robot1/arm"."""
        return f"{self.get_namespace().rstrip('/')}/{self.get_name()}"

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Returns the fully qualified name of a topic, remapped unless `only_expand`."""
        return self.__names.resolve(topic, only_expand=only_expand)

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """Returns the fully qualified name of a service, remapped unless `only_expand`."""
        return self.__names.resolve(service, is_service=True, only_expand=only_expand)

    # What it has

    @property
    def context(self) -> Context:
        """What it lives in."""
        return self.__context

    @property
    def default_callback_group(self) -> CallbackGroup:
        """The group of everything that was given none: one callback at a time."""
        return self.__default_callback_group

    @property
    def executor(self) -> Executor | None:
        """The executor it was added to; setting one adds it there."""
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
        """Its publishers."""
        yield from self.__entities[Publisher]

    @property
    def subscriptions(self) -> Iterator[Subscription]:
        """Its subscriptions."""
        yield from self.__entities[Subscription]

    @property
    def clients(self) -> Iterator[Client]:
        """Its clients."""
        yield from self.__entities[Client]

    @property
    def services(self) -> Iterator[Service]:
        """Its services."""
        yield from self.__entities[Service]

    @property
    def timers(self) -> Iterator[Timer]:
        """Its timers."""
        yield from self.__entities[Timer]

    @property
    def guards(self) -> Iterator[GuardCondition]:
        """Its guard conditions."""
        yield from self.__entities[GuardCondition]

    def get_clock(self) -> Clock:
        """Returns its clock: ROS time, which follows /clock where `use_sim_time` is set."""
        return self.__clock

    def get_logger(self) -> RcutilsLogger:
        """Returns its logger."""
        return self.__logger

    # Making and ending what it has

    def create_publisher(
        self,
        msg_type: type[Any],
        topic: str,
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
    ) -> Publisher:
        """Makes a publisher.

        Args:
            msg_type: Class of the messages.
            topic: Name of the topic; expanded and remapped.
            qos_profile: A profile, or how many messages are kept for slow subscriptions.
            callback_group: Accepted for upstream's sake; publishers have no callbacks.
            qos_overriding_options: Which policies parameters may override; None: none.

        Raises:
            InvalidQosOverridesError: A parameter is no value of its policy.
            InvalidTopicNameException: The name breaks a rule.
            NoTypeSupportImportedException: `msg_type` is no message class.
        """
        del callback_group
        check_is_valid_msg_type(msg_type)
        qos = qos_from(qos_profile)
        self.__check_alive()
        name = self.resolve_topic_name(topic)
        if qos_overriding_options is not None:
            qos = overridden(self, "publisher", name, qos, qos_overriding_options)
        wire = self._wire.publisher(self._graph_node, name, msg_type, qos._to_wire())
        return self.__add(Publisher(wire, msg_type, name, qos, self.context))

    def create_subscription(
        self,
        msg_type: type[Any],
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> Subscription:
        """Makes a subscription.

        Args:
            msg_type: Class of the messages.
            topic: Name of the topic; expanded and remapped.
            callback: Called with each message, and with a dict of its time stamps if it takes two arguments; may be a
                coroutine function.
            qos_profile: A profile, or how many messages wait until an executor takes them.
            callback_group: None: the node's default group.
            qos_overriding_options: Which policies parameters may override; None: none.
            raw: The callback gets the messages' bytes.

        Raises:
            InvalidQosOverridesError: A parameter is no value of its policy.
            InvalidTopicNameException: The name breaks a rule.
            NoTypeSupportImportedException: `msg_type` is no message class.
        """
        check_is_valid_msg_type(msg_type)
        _check_callback(callback)
        qos = qos_from(qos_profile)
        self.__check_alive()
        name = self.resolve_topic_name(topic)
        if qos_overriding_options is not None:
            qos = overridden(self, "subscription", name, qos, qos_overriding_options)
        wakeup = self.context._wakeup.event
        wire = self._wire.subscription(self._graph_node, name, msg_type, qos._to_wire(), on_data=wakeup)
        group = self.__group(callback_group)
        return self.__add(Subscription(wire, msg_type, name, callback, group, qos, raw))

    def create_client(
        self,
        srv_type: Any,
        srv_name: str,
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Client:
        """Makes a client of a service.

        Args:
            srv_type: Class of the service.
            srv_name: Its name; expanded and remapped.
            qos_profile: Of requests and responses.
            callback_group: None: the node's default group.

        Raises:
            InvalidServiceNameException: The name breaks a rule.
            NoTypeSupportImportedException: `srv_type` is no service class.
        """
        check_is_valid_srv_type(srv_type)
        self.__check_alive()
        name, qos, graph_node = self.resolve_service_name(srv_name), qos_profile._to_wire(), self._graph_node
        wakeup = self.context._wakeup.event
        replies = self._wire.subscription(graph_node, name, srv_type.Response, qos, on_data=wakeup, kind="reply")
        requests = self._wire.publisher(graph_node, name, srv_type.Request, qos, kind="request")
        group = self.__group(callback_group)
        return self.__add(
            Client(self.context, self._wire, requests, replies, self.__get_executor, srv_type, name, qos_profile, group)
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
        """Makes a service.

        Args:
            srv_type: Its class.
            srv_name: Its name; expanded and remapped.
            callback: Called with the request and an empty response, returns the response; may be a coroutine function.
            qos_profile: Of requests and responses.
            callback_group: None: the node's default group.

        Raises:
            InvalidServiceNameException: The name breaks a rule.
            NoTypeSupportImportedException: `srv_type` is no service class.
        """
        return self._create_service(Service, srv_type, srv_name, callback, qos_profile, callback_group)

    def _create_service(
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
        self.__check_alive()
        name, qos, graph_node = self.resolve_service_name(srv_name), qos_profile._to_wire(), self._graph_node
        wakeup = self.context._wakeup.event
        # The replies first: clients that see where requests go must be able to get an answer.
        replies = self._wire.publisher(graph_node, name, srv_type.Response, qos, kind="reply")
        requests = self._wire.subscription(graph_node, name, srv_type.Request, qos, on_data=wakeup, kind="request")
        group = self.__group(callback_group)
        return self.__add(kind(requests, replies, srv_type, name, callback, group, qos_profile))

    def create_timer(
        self,
        timer_period_sec: float,
        callback: Callable[[], Any],
        callback_group: CallbackGroup | None = None,
        clock: Clock | None = None,
    ) -> Timer:
        """Makes a timer.

        Args:
            timer_period_sec: Its period in seconds.
            callback: Called without arguments; may be a coroutine function.
            callback_group: None: the node's default group.
            clock: Of its period; None: the node's clock.
        """
        _check_callback(callback)
        self.__check_alive()
        period_ns = int(float(timer_period_sec) * S_TO_NS)
        group = self.__group(callback_group)
        return self.__add(Timer(callback, group, period_ns, clock or self.__clock, context=self.context))

    def create_guard_condition(
        self, callback: Callable[[], Any], callback_group: CallbackGroup | None = None
    ) -> GuardCondition:
        """Makes a guard condition.

        Args:
            callback: Called after it was triggered; may be a coroutine function.
            callback_group: None: the node's default group.
        """
        self.__check_alive()
        return self.__add(GuardCondition(callback, self.__group(callback_group), context=self.context))

    def create_rate(self, frequency: float, clock: Clock | None = None) -> Rate:
        """Makes a rate, whose `sleep()` keeps a loop at a frequency.

        Args:
            frequency: In hertz.
            clock: None: the node's clock.

        Raises:
            ValueError: The frequency is not positive.
        """
        if frequency <= 0:
            raise ValueError("frequency must be > 0")
        self.__check_alive()
        group, period_ns = self.__default_callback_group, int(S_TO_NS / frequency)
        timer = Timer(None, group, period_ns, clock or self.__clock, context=self.context)
        return self.__add(Rate(timer, context=self.context))

    def destroy_publisher(self, publisher: Publisher) -> bool:
        """Ends a publisher; False: it is not this node's."""
        return self.__remove(publisher)

    def destroy_subscription(self, subscription: Subscription) -> bool:
        """Ends a subscription; False: it is not this node's."""
        return self.__remove(subscription)

    def destroy_client(self, client: Client) -> bool:
        """Ends a client; False: it is not this node's."""
        return self.__remove(client)

    def destroy_service(self, service: Service) -> bool:
        """Ends a service; False: it is not this node's."""
        return self.__remove(service)

    def destroy_timer(self, timer: Timer) -> bool:
        """Ends a timer; False: it is not this node's."""
        return self.__remove(timer)

    def destroy_guard_condition(self, guard: GuardCondition) -> bool:
        """Ends a guard condition; False: it is not this node's."""
        return self.__remove(guard)

    def destroy_rate(self, rate: Rate) -> bool:
        """Ends a rate; False: it is not this node's."""
        return self.__remove(rate)

    def destroy_node(self) -> None:
        """Ends everything the node has and takes it out of the graph; doing so twice is no error."""
        with self.__lock:
            if self.__is_destroyed:
                return
            self.__is_destroyed = True
        if self.executor is not None:
            self.executor.remove_node(self)
        for entities in self.__entities.values():
            while entities:
                entities.pop().destroy()
        self.__executables = ()
        if self.__rosout is not None:
            self.__rosout.close()
        self._graph_node.close()
        self._wire.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.destroy_node()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.get_fully_qualified_name()}>"

    def _adopt(self, entity: EntityT) -> EntityT:
        """Makes a publisher or subscription that tf2_ros made one of the node's: listed, and ended with it."""
        return self.__add(entity)

    def _executables(self) -> tuple[Executable, ...]:
        """What an executor has to look at."""
        return self.__executables

    def _on_parameter_set(self, parameter: Parameter[Any]) -> None:
        if parameter.name == USE_SIM_TIME_NAME:
            self.__time_source.ros_time_is_active = parameter.value is True

    def __get_executor(self) -> Executor | None:
        return self.executor

    def __check_alive(self) -> None:
        if self.__is_destroyed:
            raise InvalidHandle("cannot use Node because destruction was requested")

    def __group(self, group: CallbackGroup | None) -> CallbackGroup:
        return self.__default_callback_group if group is None else group

    def __add(self, entity: EntityT) -> EntityT:
        with self.__lock:
            self.__entities_like(entity).append(entity)
            self.__collect_executables()
        group = getattr(entity, "callback_group", None)
        if group is not None:
            group.add_entity(entity)
        self.context._wakeup.set()
        return entity

    def __remove(self, entity: Any) -> bool:
        with self.__lock:
            entities = self.__entities_like(entity)
            if entity not in entities:
                return False
            entities.remove(entity)
            self.__collect_executables()
        entity.destroy()
        return True

    def __entities_like(self, entity: Any) -> list[Any]:
        return next((entities for kind, entities in self.__entities.items() if isinstance(entity, kind)), [])

    def __collect_executables(self) -> None:
        """Executors read the tuple without a lock."""
        self.__executables = tuple(
            entity
            for kind in (Timer, Subscription, GuardCondition, Client, Service)
            for entity in self.__entities[kind]
        )


def _check_callback(callback: object) -> None:
    if not callable(callback):
        raise TypeError(f"the callback must be a function, not {callback!r}: give it without () behind its name")


def _no_executor() -> None:
    return None


def _arguments_for(context: Context, cli_args: list[str] | None, *, use_global_arguments: bool) -> Arguments:
    """The node's own command line, and behind it the process's."""
    shared = context._arguments if use_global_arguments else Arguments()
    own = _arguments.parse(cli_args) if cli_args else Arguments()
    return Arguments(
        remaps=own.remaps + shared.remaps,
        # Of parameters the last one counts.
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
