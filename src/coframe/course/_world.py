# SPDX-License-Identifier: Apache-2.0
"""The simulated environment of a student's node: its clock, its inputs and its outputs."""

from __future__ import annotations

import time
from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple

import rclpy
from builtin_interfaces.msg import Time
from coframe.course._patience import FairTimeout
from coframe.time import MILLISECOND, SECOND
from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from types import TracebackType

    from typing_extensions import Self

    from coframe.course._program import StudentProgram
    from coframe.transform.transform import Transform

__all__ = ["MAX_MESSAGES", "STEP", "Received", "World", "stamp_of"]

STEP = 10 * MILLISECOND  # step of the simulated clock
_START = 1000 * SECOND
_NOT_JOINED_VIOLATION = "The program does not join the ROS graph. Call rclpy.init() and spin a node."
_NODE = "lab_check"
_RECORDER = "/coframe_record"  # the node of coframe record, which runs next to all programs
_CLOCK = "/clock"
_USE_SIM_TIME = "use_sim_time"
_START_TIMEOUT = 15.0  # time limit for the node of a program to join the graph; see Patience
_RESPONSE = 1.0  # seconds that a node may take for one callback, see Patience
_MATCHING = 2.0  # seconds that a subscription may need to find a publisher, see Patience
_MAX_MISSING_RESPONSES = 5  # responses after which the world stops waiting for the node
MAX_MESSAGES = 1000  # per program and step; at the highest rate of the lab, it publishes one
_TOO_MANY_MESSAGES = "The program publishes without a pause and was stopped. Publish in the callback of a timer."
_GRAPH_PERIOD = 25 * STEP  # seconds between two checks of the publishers of the world's topics
_QUIET_TIME = 0.002  # seconds of real time without a message after which a step is complete
_UNRESPONSIVE_STEP_TIME = 0.01  # seconds of real time per step for a node that does not respond


class Received(NamedTuple):
    """A message with the times at which it arrived.

    Attributes:
        time: The simulated time in nanoseconds.
        message: The message.
        arrived: The real time of a monotonic clock, in seconds.
    """

    time: int
    message: Any
    arrived: float = 0.0


class World:
    """A simulated clock that advances in steps, and waits for the student's node after each step.

    A grade therefore does not depend on the speed or load of the machine.

    Attributes:
        now: The simulated time in nanoseconds.
    """

    def __init__(self) -> None:
        rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
        self.now = _START
        self._node = rclpy.create_node(
            _NODE, use_global_arguments=False, enable_rosout=False, start_parameter_services=False
        )
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self._node)
        self._clock = self._node.create_publisher(Clock, _CLOCK, 10)
        self._publishers: dict[str, Any] = {}
        self._subscriptions: list[Any] = []
        self._messages = self._messages_before = 0
        self._probes: deque[Any] = deque()
        self._missed_steps = 0
        self._intruders: dict[str, set[str]] = {}
        self._program: StudentProgram | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._executor.shutdown()
        self._node.destroy_node()
        rclpy.shutdown()

    def publish(self, topic: str, message: Any, *, latched: bool = False) -> None:
        """Publish a message. The publisher is created on first use."""
        if topic not in self._publishers:
            publisher = self._node.create_publisher(type(message), topic, _qos(100, latched=latched))
            self._publishers[topic] = publisher
            # On a busy machine, the program may need many steps to discover a new publisher, and would miss messages.
            self.wait_until(
                lambda: publisher.get_subscription_count() >= self._node.count_subscribers(topic), _MATCHING
            )
        self._publishers[topic].publish(message)

    def publish_transforms(self, transforms: Iterable[Transform], stamp: int, *, static: bool = False) -> None:
        """Publish transforms with a stamp in nanoseconds on /tf or /tf_static."""
        messages = [_message(transform, stamp) for transform in transforms]
        self.publish("/tf_static" if static else "/tf", TFMessage(transforms=messages), latched=static)

    def stop_publishing(self) -> None:
        """Destroy all publishers except the clock, so that latched messages do not reach the next program."""
        for publisher in self._publishers.values():
            self._node.destroy_publisher(publisher)
        self._publishers.clear()

    def watch(self, topic: str, message_class: Any, *, latched: bool = False) -> list[Received]:
        """Subscribe to a topic until the program is stopped, and return the list that receives its messages."""
        received: list[Received] = []

        def store(message: Any) -> None:
            self._messages += 1
            received.append(Received(self.now, message, time.monotonic()))

        qos = _qos(1000, latched=latched, reliable=latched)
        self._subscriptions.append(self._node.create_subscription(message_class, topic, store, qos))
        return received

    def watched_topics(self) -> list[str]:
        """Return the topics to which the world has subscribed for the running program."""
        return list(dict.fromkeys(subscription.topic_name for subscription in self._subscriptions))

    def has_received(self) -> bool:
        """Return whether a message has arrived since the program was started."""
        return self._messages > self._messages_before

    def publishers_of(self, topic: str) -> list[Any]:
        """Return information about the publishers of a topic in other processes.

        A program can use the name of the world's node, so only one publisher with that name is excluded.
        """
        publishers = list(self._node.get_publishers_info_by_topic(topic))
        if topic == _CLOCK or topic in self._publishers:
            own = next((info for info in publishers if info.node_name == _NODE), None)
            publishers = [info for info in publishers if info is not own]
        return publishers

    def has_subscription(self, topic: str) -> bool:
        """Return whether the running program subscribes to a topic, to which the world itself does not subscribe."""
        return self._node.count_subscribers(topic) > 0

    def subscribed_topics(self, type_name: str) -> list[str]:
        """Return the topics of a type to which nodes of the running program subscribe."""
        found = set()
        for name, space in self._node.get_node_names_and_namespaces():
            if name != _NODE:
                topics = self._node.get_subscriber_names_and_types_by_node(name, space)
                found |= {topic for topic, types in topics if type_name in types}
        return sorted(found)

    def published_topics(self, type_name: str) -> list[str]:
        """Return the topics of a type on which the running program publishes, without those of the world."""
        topics = dict(self._node.get_topic_names_and_types())
        return sorted(topic for topic, types in topics.items() if type_name in types and self.publishers_of(topic))

    def output_topic(self, topic: str, type_name: str) -> str:
        """Return the topic on which the running program publishes the messages of a task.

        It is the topic of the task, unless the program publishes messages of that type only on one other topic.
        """
        self.wait_until(lambda: bool(self.publishers_of(topic) or self.published_topics(type_name)), _MATCHING)
        others = self.published_topics(type_name)
        return others[0] if len(others) == 1 and not self.publishers_of(topic) else topic

    def intruders(self) -> dict[str, list[str]]:
        """Return the topics of the world on which the running program publishes, with the names of its nodes."""
        self._find_intruders()
        return {topic: sorted(names) for topic, names in self._intruders.items()}

    def _find_intruders(self) -> None:
        for topic in (_CLOCK, *self._publishers):
            if names := {info.node_name for info in self.publishers_of(topic)}:
                self._intruders.setdefault(topic, set()).update(names)

    def start(self, program: StudentProgram) -> None:
        """Start a program and wait until its node has joined the graph. The program may end earlier."""
        self._program = program
        self._intruders.clear()
        self._messages_before = self._messages
        self._missed_steps = 0
        program.start()
        patience = FairTimeout(_START_TIMEOUT, program.waiting_time)
        while not patience.is_over() and program.is_running():
            names = self._other_nodes()
            if names and self._node.count_subscribers(_CLOCK) and all(map(self._has_parameters, names)):
                break
            self._executor.spin_once(timeout_sec=0.02)
        else:
            if program.is_running():
                program.violation = _NOT_JOINED_VIOLATION
        for name in self._other_nodes():
            if self._has_parameters(name):
                self._probes.append(self._node.create_client(GetParameters, f"{name}/get_parameters"))
        for probe in self._probes:
            probe.wait_for_service(_RESPONSE)

    def stop(self) -> None:
        """Stop the program and wait until its node has left the graph."""
        if self._program is not None:
            self._program.stop()
        for probe in self._probes:
            self._node.destroy_client(probe)
        self._probes.clear()
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()
        deadline = time.monotonic() + _START_TIMEOUT
        while self._other_nodes() and time.monotonic() < deadline:
            time.sleep(0.01)
        self._program = None

    def run(self, seconds: float, each_step: Callable[[int], None] | None = None) -> None:
        """Advance the simulated clock.

        Args:
            seconds: The simulated time to advance, in seconds.
            each_step: Called in each step with the time in nanoseconds, before the student's node runs.
        """
        end = self.now + round(seconds * SECOND)
        while self.now < end and self._program is not None and self._program.is_running():
            self.now += STEP
            self._clock.publish(Clock(clock=stamp_of(self.now)))
            if each_step is not None:
                each_step(self.now)
            self.settle()
            if self.now % _GRAPH_PERIOD == 0:
                self._find_intruders()

    def jump(self, seconds: float) -> None:
        """Advance the simulated clock in a single step, as on a busy robot, where a timer is late."""
        if self._program is not None and self._program.is_running():
            self.now += round(seconds * SECOND)
            self._clock.publish(Clock(clock=stamp_of(self.now)))
            self.settle()

    def use_system_time(self, seconds: float, is_enough: Callable[[], bool]) -> None:
        """Let the program run with the clock of the system, for a time in seconds or until a condition is true.

        On this clock, two calls of now() return different times, even in one callback.

        Args:
            seconds: The time limit.
            is_enough: Called repeatedly; it can also publish.
        """
        clients = [self._node.create_client(SetParameters, f"{name}/set_parameters") for name in self._other_nodes()]
        value = ParameterValue(type=ParameterType.PARAMETER_BOOL, bool_value=False)
        request = SetParameters.Request(parameters=[Parameter(name=_USE_SIM_TIME, value=value)])
        try:
            if self._is_responding():
                futures = [client.call_async(request) for client in clients if client.wait_for_service(_RESPONSE)]
                self.wait_until(lambda: all(future.done() for future in futures), _RESPONSE)
                self.wait_until(is_enough, seconds)
        finally:
            for client in clients:
                self._node.destroy_client(client)

    def responds(self, at_most: float, at_least: float = 0.0) -> bool:
        """Return whether the program responds to requests, without advancing the clock.

        A program with a single thread does not respond while a callback waits.

        Args:
            at_most: The time limit in seconds, see Patience.
            at_least: The minimum of real time to wait, in seconds.
        """
        patience = FairTimeout(at_most, self._waiting_time)
        deadline = time.monotonic() + at_least
        answered = True
        for _ in range(2):  # The first response may come before a callback that is also ready, see `settle`.
            futures = [probe.call_async(_probe_request()) for probe in self._probes]
            while not patience.is_over() and not all(future.done() for future in futures):
                self._spin(_QUIET_TIME)
            answered = answered and all(future.done() for future in futures)
        self._spin(max(0.0, deadline - time.monotonic()))
        return answered

    def is_blocked(self) -> bool:
        """Return whether the node of the running program has stopped responding, for example because it never spins."""
        return bool(self._probes) and not self._is_responding()

    def _is_responding(self) -> bool:
        return self._missed_steps < _MAX_MISSING_RESPONSES

    def wait_until(self, is_true: Callable[[], bool], seconds: float) -> None:
        """Wait until a condition is true, without advancing the clock; at most a few seconds, see Patience."""
        patience = FairTimeout(seconds, self._waiting_time)
        while not (is_true() or patience.is_over()) and self._program is not None and self._program.is_running():
            self._spin(_QUIET_TIME)

    def settle(self) -> None:
        """Wait until the student's node has run all callbacks that are ready, and its messages have arrived."""
        # An executor runs everything that is ready before it runs anything twice. The first response shows that it has
        # received the clock, the second one that the timers triggered by it have run.
        for _ in range(2):
            self._await_responses()
        if not self._probes or not self._is_responding():
            time.sleep(_UNRESPONSIVE_STEP_TIME)
        first, count = self._messages, -1
        while count != self._messages:
            count = self._messages
            self._spin(_QUIET_TIME)
            if count - first > MAX_MESSAGES and self._program is not None:
                self._program.violation = _TOO_MANY_MESSAGES
                break

    def _await_responses(self) -> None:
        if not self._is_responding():
            return
        futures = [probe.call_async(_probe_request()) for probe in self._probes]
        patience = FairTimeout(_RESPONSE, self._waiting_time)
        while not (all(future.done() for future in futures) or patience.is_over()):
            for future in futures:
                self._executor.spin_until_future_complete(future, timeout_sec=_RESPONSE / 4)
        if all(future.done() for future in futures):
            self._missed_steps = 0
            return
        self._missed_steps += 1

    def _waiting_time(self) -> float:
        return 0.0 if self._program is None else self._program.waiting_time()

    def _spin(self, seconds: float) -> None:
        deadline = time.monotonic() + seconds
        while (left := deadline - time.monotonic()) > 0:
            self._executor.spin_once(timeout_sec=left)

    def _other_nodes(self) -> list[str]:
        names = [f"{space.rstrip('/')}/{name}" for name, space in self._node.get_node_names_and_namespaces()]
        for known in (self._node.get_fully_qualified_name(), _RECORDER):
            if known in names:  # once: a program can use the same name
                names.remove(known)
        return names

    def _has_parameters(self, node: str) -> bool:
        return f"{node}/get_parameters" in dict(self._node.get_service_names_and_types())


def _probe_request() -> GetParameters.Request:
    return GetParameters.Request(names=[_USE_SIM_TIME])


def stamp_of(nanoseconds: int) -> Time:
    """Return a time in nanoseconds as a message."""
    return Time(sec=nanoseconds // SECOND, nanosec=nanoseconds % SECOND)


def _qos(depth: int, *, latched: bool = False, reliable: bool = True) -> QoSProfile:
    return QoSProfile(
        depth=depth,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


def _message(transform: Transform, stamp: int) -> TransformStamped:
    message = TransformStamped(child_frame_id=transform.source or "")
    message.header.frame_id = transform.target or ""
    message.header.stamp = stamp_of(stamp)
    _set(message.transform.translation, "xyz", transform.translation.tolist())
    _set(message.transform.rotation, "xyzw", transform.quaternion.tolist())
    return message


def _set(message: Any, fields: str, values: Sequence[float]) -> None:
    for field, value in zip(fields, values, strict=True):
        setattr(message, field, value)
