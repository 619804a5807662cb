# SPDX-License-Identifier: Apache-2.0
"""Functions that tf2_ros needs from coframe's rclpy beyond the public API."""

# ruff: noqa: SLF001 - Private members of rclpy are what this module hides from the others.

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe._process.graded_programs import is_graded
from rclpy.event_handler import MismatchReporter, SubscriptionEventCallbacks
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, as_qos_profile
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.wire.qos import QoS
    from rclpy.node import Node
    from rclpy.task import Future
    from tf2_ros._subscriptions import Request

IS_SOURCED = False
profile = as_qos_profile

_PUBLISH = Publisher.publish


def receiving_wire(request: Request) -> str:
    """Return how transforms are received: "native" unless the listener asks for "rclpy".

    A graded program receives them in the callbacks of its executor, as on ROS 2, where a lookup that waits in the only
    thread of an executor never succeeds.
    """
    return request.wire or ("rclpy" if is_graded() else "native")


def domain_and_middleware(node: Node) -> tuple[int, str]:
    """Return the domain and the middleware of a node."""
    participant = node._Coframe__participant
    return participant.domain_id, participant.wire


def to_wire(qos: QoSProfile) -> QoS:
    """Return a quality of service profile as coframe's wire takes it."""
    return qos._Coframe__to_wire()


def reporter(node: Node, topic: str) -> Callable[[str, str], object]:
    """Return a function that reports publishers of a topic with another quality of service or type."""
    return MismatchReporter(SubscriptionEventCallbacks(), node.get_logger(), topic)


def static_publisher(node: Node, topic: str, qos: QoSProfile) -> Any:
    """Return a publisher of static transforms that all broadcasters of the process share."""
    name = node.resolve_topic_name(topic)
    writer = node._Coframe__participant.static_broadcaster(node._Coframe__graph_node, name)
    return node._Coframe__entities.add(Publisher(writer, TFMessage, topic, name, qos, node.context))


def direct_sender(publisher: Any) -> tuple[Callable[[Any], bool], object]:
    """Return a function that publishes transforms without a message object, and the expected `publisher.publish`.

    The function accepts a TransformStamped or a list of them. It returns False if it has published nothing, in which
    case a message must be published. Programs may replace `publish` in order to receive messages.
    """
    if type(publisher).publish is _PUBLISH:
        return publisher._Coframe__publish_items(), publisher.publish
    return (lambda _: False), None


def wait_for(action_client: Any, future: Future[Any], timeout: float) -> None:
    """Wait until an executor has completed a future of an action client, up to a timeout in seconds."""
    action_client._Coframe__wait_for(future, timeout)


def refusal(action_client: Any) -> str:
    """Return why no goal can be sent although there is a server, or "" if there is no reason."""
    reason: str = action_client._Coframe__refusal
    return reason


def on_cancel(goal_handle: Any, callback: Callable[[], object]) -> None:
    """Call a function when the client cancels a goal."""
    goal_handle._Coframe__cancel_request.add_done_callback(lambda _: callback())


def wake_executors() -> None:
    """Do nothing: a future of coframe's rclpy wakes the executor of a coroutine that awaits it."""
