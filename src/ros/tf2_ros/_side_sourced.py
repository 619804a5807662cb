# SPDX-License-Identifier: Apache-2.0
"""Functions that tf2_ros needs from the rclpy of a sourced ROS. Only its public API is used."""

from __future__ import annotations

import contextlib
import os
import threading
import weakref
from typing import TYPE_CHECKING, Any

from coframe._output.formatting import error_text
from coframe.errors import WireError
from coframe.wire import selection
from coframe.wire.qos import INFINITE, QoS
from coframe.workspace import ros_side
from rclpy.qos import QoSProfile
from rclpy.utilities import get_rmw_implementation_identifier
from tf2_msgs.msg import TFMessage
from tf2_ros._subscriptions import WIRES

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node
    from rclpy.task import Future
    from tf2_ros._subscriptions import Request

IS_SOURCED = True

_logged_messages: set[str] = set()

# A node's guard condition wakes the executor that spins the node.
_guard_conditions: weakref.WeakKeyDictionary[Node, Any] = weakref.WeakKeyDictionary()


def profile(qos: QoSProfile | int) -> QoSProfile:
    """Return the profile, or a KEEP_LAST profile with the given depth."""
    return qos if isinstance(qos, QoSProfile) else QoSProfile(depth=qos)


def receiving_wire(request: Request) -> str:
    """Return how transforms are received: as specified by the listener, the command line or COFRAME_ROS2_WIRE.

    By default, it is "native" if coframe can use the middleware of this ROS.

    Raises:
        ValueError: The environment variable has an invalid value.
    """
    _add_guard_condition(request.node)
    if chosen := request.wire or ros_side.listener_wire():
        return chosen
    wire = os.environ.get("COFRAME_ROS2_WIRE") or _default_wire(request.node)
    if wire not in WIRES:
        raise ValueError(f"COFRAME_ROS2_WIRE is {wire!r}. Valid values: {', '.join(WIRES)}.")
    return wire


def domain_and_middleware(node: Node) -> tuple[int, str]:
    """Return the domain of a node and the middleware of this ROS."""
    return node.context.get_domain_id(), selection.row_of_rmw(get_rmw_implementation_identifier()).wire


def to_wire(qos: QoSProfile) -> QoS:
    """Return a quality of service profile as coframe's wire takes it."""
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


def reporter(node: Node, topic: str) -> Callable[[str, str], object]:
    """Return a function that reports publishers of a topic with another quality of service or type."""
    del topic  # the text names it
    logger = node.get_logger()  # not the node, which could never be garbage-collected
    return lambda _, text: logger.warning(text)


def static_publisher(node: Node, topic: str, qos: QoSProfile) -> Any:
    """Return a publisher of static transforms, of this broadcaster only, as in tf2_ros."""
    return node.create_publisher(TFMessage, topic, qos)


def direct_sender(publisher: Any) -> tuple[Callable[[Any], bool], object]:
    """Return a function that publishes nothing and returns False: rclpy publishes only messages."""
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
    if problem not in _logged_messages:
        _logged_messages.add(problem)
        node.get_logger().info(f"Transforms are received through the ROS node (wire rclpy): {problem}")
    return "rclpy"


def _native_problem() -> str | None:
    """Return why coframe cannot receive messages from the nodes of this ROS, or None if it can."""
    middleware = get_rmw_implementation_identifier()
    needed = selection.row_of_rmw(middleware).wire
    if needed == "zenoh" and os.environ.get("ROS_DISTRO") == "humble":
        return "the messages of Humble on Zenoh have no type hash, which coframe needs."
    try:
        if os.environ.get(selection.VARIABLE) and selection.select().wire != needed:
            return f"{selection.VARIABLE} selects a different middleware from {middleware}."
        selection.check(needed)
    except WireError as error:
        return error_text(error)
    return None


def _add_guard_condition(node: Node) -> None:
    if node not in _guard_conditions:
        _guard_conditions[node] = node.create_guard_condition(lambda: None)
