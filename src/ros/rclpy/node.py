# SPDX-License-Identifier: Apache-2.0
"""Nodes."""

# Programs also import from this module what it does not use itself (F401), as in ROS 2.
# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import weakref
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from coframe.distributions import since
from rcl_interfaces.msg import ParameterEvent
from rclpy import _absent, _arguments, _composition, _node_endpoints
from rclpy._absent import Handle
from rclpy._arguments import Arguments
from rclpy._destroyable import destroyed_error
from rclpy._entity_registry import EntityRegistry, check_callback
from rclpy._node_parameters import NodeParameters
from rclpy._remapping import NameResolver, remap_node
from rclpy._rosout import RosoutPublisher
from rclpy.callback_groups import CallbackGroup, MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup  # noqa: F401
from rclpy.clock import Clock, ROSClock
from rclpy.constants import S_TO_NS
from rclpy.exceptions import NameValidationException, NotInitializedException, RCLError, _with_hint
from rclpy.guard_condition import GuardCondition
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.parameter import Parameter
from rclpy.parameter_service import ParameterService
from rclpy.qos import (
    QoSProfile,
    as_qos_profile,
    qos_profile_parameter_events,
    qos_profile_rosout_default,
    qos_profile_services_default,  # noqa: F401
)
from rclpy.qos_overriding_options import QoSOverridingOptions  # noqa: F401
from rclpy.time_source import USE_SIM_TIME_NAME, TimeSource
from rclpy.timer import Rate, Timer
from rclpy.type_description_service import TypeDescriptionService
from rclpy.type_support import check_is_valid_srv_type  # noqa: F401
from rclpy.utilities import get_default_context
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name
from rclpy.waitable import Waitable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from typing_extensions import Self

    from rclpy.context import Context
    from rclpy.executors import Executor, PolledSubscription

HIDDEN_NODE_PREFIX = "_"
EntityT = TypeVar("EntityT")


class Node(_node_endpoints.Node):
    """A node of the ROS graph.

    Args:
        node_name: Name of the node. `--ros-args -r __node:=` overrides it.
        context: Context of the node. None: the default context.
        cli_args: Command line with `--ros-args` for this node, which takes precedence over the command line of the
        process.
        namespace: Namespace of the node. `--ros-args -r __ns:=` overrides it.
        use_global_arguments: Whether the command line of the process applies to the node.
        enable_rosout: Whether to publish log messages on /rosout.
        start_parameter_services: Whether other nodes can get and set the parameters (`ros2 param`).
        parameter_overrides: Values that override the declared defaults and the command line.
        allow_undeclared_parameters: Whether undeclared parameters may be used.
        automatically_declare_parameters_from_overrides: Whether to declare all parameter overrides.
        enable_logger_service: Whether other nodes can get and set the log levels.
        rosout_qos_profile: QoS profile of the publisher of /rosout, or its depth.

    Raises:
        NotInitializedException: The context is not initialized or was shut down.
        InvalidNodeNameException: The name is not valid.
        InvalidNamespaceException: The namespace is not valid.
    """

    handle = Handle()
    _Coframe__clock_class: type[ROSClock] = ROSClock
    _Coframe__composed = staticmethod(_composition.apply_options)
    _Coframe__composed_options = _composition.ComposedOptions

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
        rosout_qos_profile: QoSProfile | int = qos_profile_rosout_default,
    ) -> None:
        self.__context = context or get_default_context()
        if not self.__context.ok():
            raise NotInitializedException("cannot create node")
        if (given := _composition.take_options(self)) is not None:
            cli_args = [*given.cli_args, *(cli_args or ())]
            parameter_overrides = [*(parameter_overrides or ()), *given.parameter_overrides]
            use_global_arguments = given.use_global_arguments
        arguments = _arguments_for(self.__context, cli_args, use_global_arguments=use_global_arguments)
        self._Coframe__names = _names_for(node_name, namespace or "", arguments)
        self.__executor: Callable[[], Executor | None] = _no_executor
        name = self._Coframe__names.full_name
        self.__logger = RcutilsLogger(name.lstrip("/").replace("/", "."))
        self._Coframe__entities = EntityRegistry(name, self.__logger.name, self.__context)
        self.__timers_of_rates: dict[Rate, Timer] = {}
        self.__clock: Clock = self._Coframe__clock_class()

        overrides = {
            # As in rcl, an empty list has no type yet: that of the declaration applies.
            override.name: Parameter(override.name, value=None if override.value == [] else override.value)
            for override in arguments.parameters
            if override.matches(self.get_fully_qualified_name())
        }
        overrides.update((parameter.name, parameter) for parameter in parameter_overrides or [])

        self._Coframe__participant = self.__context._Coframe__get_participant()
        self._Coframe__graph_node = self._Coframe__participant.add_node(
            self._Coframe__names.namespace, self._Coframe__names.node_name, has_parameters=True, is_complete=False
        )
        self._Coframe__polled_subscriptions: list[PolledSubscription] = []
        self.__rosout: RosoutPublisher | None = None
        if enable_rosout and arguments.logging.rosout:
            qos = as_qos_profile(rosout_qos_profile)
            self.__rosout = RosoutPublisher(
                self._Coframe__participant, self._Coframe__graph_node, self.__logger.name, qos
            )
        self._Coframe__time_sources: list[TimeSource] = []
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
            TimeSource(node=self).attach_clock(self.__clock)
            if not self.has_parameter(USE_SIM_TIME_NAME):
                self.declare_parameter(USE_SIM_TIME_NAME, False)
            if since("type_descriptions"):
                TypeDescriptionService(self)
            if start_parameter_services:
                ParameterService(self)
            if enable_logger_service:
                from rclpy.logging_service import LoggingService  # noqa: PLC0415 - few nodes have it

                LoggingService(self)
            self._Coframe__graph_node.announce()
        except BaseException:
            self.destroy_node()  # The caller has no reference to the node.
            raise

    if not TYPE_CHECKING:  # With `__getattr__`, type checkers would accept every misspelled attribute.

        def __getattr__(self, name: str) -> Any:
            if name.startswith(("_Node__", "_NodeParameters__", "_Coframe__")):
                raise AttributeError(
                    f"The node {type(self).__name__} is not initialized. "
                    "Call super().__init__('node_name') first in its __init__."
                )
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    # Names

    def get_name(self) -> str:
        """Return the name without the namespace.

        Raises:
            InvalidHandle: The node was destroyed.
        """
        self.__check_exists()
        return self._Coframe__names.node_name

    def get_namespace(self) -> str:
        """Return the namespace, for example "/" or "/robot1".

        Raises:
            InvalidHandle: The node was destroyed.
        """
        self.__check_exists()
        return self._Coframe__names.namespace

    def get_fully_qualified_name(self) -> str:
        """Return the name with the namespace, for example "/robot1/arm".

        Raises:
            InvalidHandle: The node was destroyed.
        """
        self.__check_exists()
        return self._Coframe__names.full_name

    def __check_exists(self) -> None:
        if self._Coframe__entities.is_destroyed:
            raise destroyed_error(f"The node {self._Coframe__names.full_name}")

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
            return self._Coframe__names.resolve(name, is_service=is_service, only_expand=only_expand)
        except NameValidationException as error:
            raise _with_hint(RCLError(f"failed to resolve name: {error.error_msg}"), f"The name is {name!r}.") from None
        except ValueError as error:
            reason = str(error).rpartition(": unknown substitution: ")[2]
            raise RCLError(f"failed to resolve name: unknown substitution: {reason}") from None

    # Properties

    @property
    def context(self) -> Context:
        """The context of the node."""
        return self.__context

    @property
    def default_callback_group(self) -> CallbackGroup:
        """The callback group of entities created without a group. It is mutually exclusive."""
        return self._Coframe__entities.default_group

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
    def timers(self) -> Iterator[Timer]:
        """The timers of the node."""
        yield from self._Coframe__entities.of(Timer)

    @property
    def guards(self) -> Iterator[GuardCondition]:
        """The guard conditions of the node."""
        yield from self._Coframe__entities.of(GuardCondition)

    def get_clock(self) -> Clock:
        """Return the clock of the node, which is set from /clock if `use_sim_time` is true."""
        return self.__clock

    def get_logger(self) -> RcutilsLogger:
        """Return the logger of the node."""
        return self.__logger

    # Timers, guard conditions, rates and waitables

    def create_timer(
        self,
        timer_period_sec: float,
        callback: Callable[..., Any],
        callback_group: CallbackGroup | None = None,
        clock: Clock | None = None,
        autostart: bool = True,
    ) -> Timer:
        """Create a timer.

        Args:
            timer_period_sec: Period in seconds.
            callback: Function or coroutine function. It is called without arguments; a parameter that is annotated with
                `rclpy.timer.TimerInfo` gets the times of the call.
            callback_group: Group of the callback. None: the default group of the node.
            clock: Clock that measures the period. None: the clock of the node.
            autostart: Whether the timer starts now, and not with its `reset()`.
        """
        check_callback(callback)
        self._Coframe__entities.check_usable("timer")
        period_ns = int(float(timer_period_sec) * S_TO_NS)
        group = self._Coframe__entities.group(callback_group)
        timer = Timer(callback, group, period_ns, clock or self.__clock, context=self.context, autostart=autostart)
        return self._Coframe__entities.add(timer)

    def create_guard_condition(
        self, callback: Callable[[], Any], callback_group: CallbackGroup | None = None
    ) -> GuardCondition:
        """Create a guard condition.

        Args:
            callback: Function or coroutine function that is called after a trigger.
            callback_group: Group of the callback. None: the default group of the node.
        """
        self._Coframe__entities.check_usable("guard_condition")
        return self._Coframe__entities.add(
            GuardCondition(callback, self._Coframe__entities.group(callback_group), context=self.context)
        )

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
        self._Coframe__entities.check_not_destroyed()
        # Its own group, so that the callbacks of the node do not delay the end of a period.
        timer = self.create_timer(1 / frequency, _do_nothing, ReentrantCallbackGroup(), clock)
        rate = self._Coframe__entities.add(Rate(timer, context=self.context))
        self.__timers_of_rates[rate] = timer
        return rate

    def add_waitable(self, waitable: Waitable) -> None:
        """Add a waitable of the user, which executors of this node run."""
        self._Coframe__entities.add_waitable(waitable)

    def remove_waitable(self, waitable: Waitable) -> None:
        """Remove a waitable.

        Raises:
            ValueError: The waitable was not added.
        """
        self._Coframe__entities.remove_waitable(waitable)

    @property
    def waitables(self) -> Iterator[Waitable]:
        """The waitables of the user, and the handlers of QoS events."""
        yield from self._Coframe__entities.of(Waitable)

    def destroy_timer(self, timer: Timer) -> bool:
        """Destroy a timer. Return False if it does not belong to this node."""
        return self._Coframe__entities.remove(timer)

    def destroy_guard_condition(self, guard: GuardCondition) -> bool:
        """Destroy a guard condition. Return False if it does not belong to this node."""
        return self._Coframe__entities.remove(guard)

    def destroy_rate(self, rate: Rate) -> bool:
        """Destroy a rate. Return False if it does not belong to this node."""
        timer = self.__timers_of_rates.pop(rate, None)
        return self._Coframe__entities.remove(rate) and timer is not None and self._Coframe__entities.remove(timer)

    def destroy_node(self) -> None:
        """Destroy all entities of the node and remove it from the graph. Repeated calls have no effect."""
        if not self._Coframe__entities.begin_destruction():
            return
        if self.executor is not None:
            self.executor.remove_node(self)
        self._Coframe__graph_node.hold()
        self._Coframe__entities.destroy_all()
        if self.__rosout is not None:
            self.__rosout.close()
        self._Coframe__graph_node.close()
        self._Coframe__participant.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.destroy_node()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self._Coframe__names.full_name}>"

    def _Coframe__on_parameter_set(self, parameter: Parameter[Any]) -> None:
        if parameter.name == USE_SIM_TIME_NAME:
            for source in tuple(self._Coframe__time_sources):
                source.ros_time_is_active = parameter.value is True

    def _Coframe__publish_parameter_event(self, event: ParameterEvent) -> None:
        event.node = self.get_fully_qualified_name()
        event.stamp = self.__clock.now().to_msg()
        self.__parameter_events.publish(event)


def _do_nothing() -> None:
    """Do nothing at the end of a rate's period, except that `spin_once` returns."""


def _no_executor() -> None:
    return None


def _arguments_for(context: Context, cli_args: list[str] | None, *, use_global_arguments: bool) -> Arguments:
    """Return the arguments of the node, combined with the process's arguments, which have lower precedence."""
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


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
