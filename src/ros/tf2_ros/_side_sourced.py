# SPDX-License-Identifier: Apache-2.0
"""What tf2_ros needs from the rclpy of a sourced ROS. Only its public API is used."""

from __future__ import annotations

import contextlib
import os
import threading
import weakref
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from coframe.errors import WireError
from coframe.wire import Participant, QoS, selection
from coframe.wire.qos import INFINITE
from rclpy.qos import QoSProfile
from rclpy.utilities import get_rmw_implementation_identifier
from tf2_msgs.msg import TFMessage
from tf2_ros._sharing import SharedReader, share
from tf2_ros._subscriptions import AUTHORITY, WIRES, CallbackSubscriptions, Request, Subscriptions, Topic

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.wire import GraphNode, TfReader
    from rclpy.node import Node
    from rclpy.task import Future
    from tf2_ros._sharing import Sharing

_logged: set[str] = set()

# A node's guard condition wakes the executor that spins the node.
_guard_conditions: weakref.WeakKeyDictionary[Node, Any] = weakref.WeakKeyDictionary()


def profile(qos: QoSProfile | int) -> QoSProfile:
    """Return the profile, or a KEEP_LAST profile with the given depth."""
    return qos if isinstance(qos, QoSProfile) else QoSProfile(depth=qos)


def open_subscriptions(request: Request) -> Subscriptions:
    """Subscribe natively or with raw subscriptions of the node, as the request or `COFRAME_ROS2_WIRE` says.

    By default, the subscriptions are native if coframe can use the middleware of this ROS. With COFRAME_SHARED=1,
    native subscriptions are shared with the other processes of this user.

    Raises:
        ValueError: The environment variable has another value.
    """
    _add_guard_condition(request.node)
    wire = request.wire or os.environ.get("COFRAME_ROS2_WIRE") or _default_wire(request.node)
    if wire not in WIRES:
        raise ValueError(f"COFRAME_ROS2_WIRE is {wire!r}. Valid values: {', '.join(WIRES)}.")
    if wire == "native":
        report = _reporter(request.node)
        sharing = share(request, request.node.context.get_domain_id(), _to_wire, lambda _: report)
        return _NativeSubscriptions(request) if sharing is None else _SharedSubscriptions(request, sharing)
    # Only the native wire renames frames.
    return _RawSubscriptions(request) if request.renaming is None else CallbackSubscriptions(request)


def static_publisher(node: Node, topic: str, qos: QoSProfile) -> Any:
    """Return a publisher of static transforms, of this broadcaster only, as in tf2_ros."""
    return node.create_publisher(TFMessage, topic, qos)


def direct_sender(publisher: Any) -> tuple[Callable[[Any], bool], object]:
    """Return a function that publishes nothing and returns False: rclpy publishes messages only."""
    del publisher
    return (lambda _: False), None


def wait_for(action_client: Any, future: Future[Any], timeout: float) -> None:
    """Wait until an executor has completed a future of an action client, up to a timeout in seconds."""
    del action_client
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    done.wait(timeout)


def refusal(action_client: Any) -> str:
    """Return "": the middleware of a sourced ROS does not report why a server cannot be called."""
    del action_client
    return ""


def on_cancel(goal_handle: Any, callback: Callable[[], object]) -> None:
    """Do nothing: rclpy has no event for this, so a cancelled goal ends at its timeout."""
    del goal_handle, callback


def wake_executors() -> None:
    """Let the executors of listeners' nodes continue coroutines whose futures another thread has completed."""
    for guard_condition in list(_guard_conditions.values()):
        with contextlib.suppress(Exception):  # The node was destroyed; rclpy's exceptions differ by distribution.
            guard_condition.trigger()


def _default_wire(node: Node) -> str:
    problem = _native_problem()
    if problem is None:
        return "native"
    if problem not in _logged:
        _logged.add(problem)
        node.get_logger().info(f"Transforms are received through the ROS node (wire rclpy): {problem}")
    return "rclpy"


def _native_problem() -> str | None:
    """Return why coframe cannot receive what the nodes of this ROS publish; None if it can."""
    middleware = get_rmw_implementation_identifier()
    needed = "zenoh" if "zenoh" in middleware else "dds"
    if needed == "zenoh" and os.environ.get("ROS_DISTRO") == "humble":
        return "the messages of Humble on Zenoh have no type hash, which coframe needs."
    try:
        if selection.select().wire != needed:
            if os.environ.get(selection.VARIABLE):
                return f"{selection.VARIABLE} selects another middleware than {middleware}."
            os.environ[selection.VARIABLE] = needed
        selection.check()
    except WireError as error:
        return f"{error} {error.hint}".strip()
    return None


def _add_guard_condition(node: Node) -> None:
    if node not in _guard_conditions:
        _guard_conditions[node] = node.create_guard_condition(lambda: None)


class _NativeSubscriptions:
    """Subscriptions of a hidden node of coframe with the name, namespace and domain of the ROS node.

    They work with every middleware that coframe can use, and end with the node at the latest.
    """

    def __init__(self, request: Request) -> None:
        node = request.node
        participant = Participant.get(node.context.get_domain_id())
        try:
            hidden = participant.add_node(node.get_namespace(), f"_{node.get_name()}_coframe_tf")
        except BaseException:
            participant.close()
            raise
        # No reference to the node is kept, because it could never be garbage-collected.
        self.close = weakref.finalize(node, _leave, participant, hidden)
        self.dynamic = (
            None if request.dynamic is None else _read(request, request.dynamic, participant, hidden, static=False)
        )
        self.static = _read(request, request.static, participant, hidden, static=True)


def _leave(participant: Participant, hidden: GraphNode) -> None:
    hidden.close()
    participant.close()


def _read(request: Request, topic: Topic, participant: Participant, hidden: GraphNode, *, static: bool) -> TfReader:
    return participant.tf_reader(
        hidden,
        request.node.resolve_topic_name(topic.name),
        request.buffer._Coframe__buffer,  # noqa: SLF001 - tf2's buffers have no public name for coframe's
        static=static,
        qos=_to_wire(topic.qos),
        authority=AUTHORITY,
        renaming=request.renaming,
        on_mismatch=_reporter(request.node),
    )


def _reporter(node: Node) -> Callable[[str, str], object]:
    logger = node.get_logger()  # not the node, which could never be garbage-collected
    return lambda _, text: logger.warning(text)


def _to_wire(qos: QoSProfile) -> QoS:
    return QoS(
        depth=max(qos.depth, 1),
        reliable=qos.reliability.name != "BEST_EFFORT",
        transient_local=qos.durability.name == "TRANSIENT_LOCAL",
        keep_all=qos.history.name == "KEEP_ALL",
        manual_liveliness=qos.liveliness.name == "MANUAL_BY_TOPIC",
        deadline=qos.deadline.nanoseconds or INFINITE,
        lifespan=qos.lifespan.nanoseconds or INFINITE,
        lease=qos.liveliness_lease_duration.nanoseconds or INFINITE,
    )


class _SharedSubscriptions:
    """The buffer reads the shared transforms, until the node ends or the program changes the buffer."""

    def __init__(self, request: Request, sharing: Sharing) -> None:
        # No reference to the node is kept, because it could never be garbage-collected.
        self._sharing = sharing
        self._own: _NativeSubscriptions | None = None
        self._leave = weakref.finalize(request.node, sharing.leave)
        self._node = weakref.ref(request.node)
        self.dynamic, self.static = (SharedReader(self.close, partial(self._count, topic)) for topic in sharing.topics)
        assert request.dynamic is not None
        self._request = partial(
            Request,
            buffer=request.buffer,
            group=request.group,
            renaming=request.renaming,
            dynamic=replace(request.dynamic, callback=_ignore),
            static=replace(request.static, callback=_ignore),
        )
        sharing.on_local_change(self._receive_alone)

    def _count(self, topic: str) -> int:
        node = self._node()
        return 0 if node is None else self._sharing.count_publishers(node, topic)

    def close(self) -> None:
        self._leave()
        if self._own is not None:
            self._own.close()

    def _receive_alone(self) -> None:
        node = self._node()
        if node is not None:
            self._own = _NativeSubscriptions(self._request(node=node))


def _ignore(message: TFMessage) -> None:
    del message


class _RawSubscriptions:
    """Subscriptions of the node to serialized messages, which coframe decodes: for any middleware of this ROS."""

    def __init__(self, request: Request) -> None:
        self._node = request.node
        self.dynamic = None if request.dynamic is None else self._open(request, request.dynamic, static=False)
        self.static = self._open(request, request.static, static=True)

    def _open(self, request: Request, topic: Topic, *, static: bool) -> Any:
        buffer = request.buffer._Coframe__buffer  # noqa: SLF001 - tf2's buffers have no public name for coframe's

        def ingest(message: bytes) -> None:
            with buffer._dispatcher.inserting():
                buffer.ingest(message, static=static, authority=AUTHORITY)

        return self._node.create_subscription(
            TFMessage, topic.name, ingest, topic.qos, callback_group=request.group, raw=True
        )

    def close(self) -> None:
        for subscription in (self.dynamic, self.static):
            if subscription is not None:
                self._node.destroy_subscription(subscription)
