"""Waiting for one message."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from coframe._core import Event
from coframe.messages import codec

from rclpy.constants import S_TO_NS
from rclpy.qos import QoSProfile, qos_from

if TYPE_CHECKING:
    from rclpy.node import Node


def wait_for_message(
    msg_type: type[Any],
    node: Node,
    topic: str,
    *,
    qos_profile: QoSProfile | int = 1,
    time_to_wait: float = -1,
) -> tuple[bool, Any]:
    """Waits for the next message of a topic.

    Args:
        msg_type: Class of the message.
        node: Subscribes for this time; need not be spinning.
        topic: Name of the topic.
        qos_profile: Of the subscription.
        time_to_wait: Longest wait in seconds; negative: as long as it takes.

    Returns:
        Whether there was one in time, and the message or None; also (False, None) when the context shut down.
    """
    deadline = None if time_to_wait < 0 else time.monotonic_ns() + int(time_to_wait * S_TO_NS)
    event = Event()
    name, qos = node.resolve_topic_name(topic), qos_from(qos_profile)._to_wire()
    subscription = node._wire.subscription(node._graph_node, name, msg_type, qos, on_data=event)
    try:
        with node.context._setting_at_shutdown(event):
            while node.context.ok():
                if samples := subscription.take(limit=1):
                    return True, codec.deserialize(samples[0].data, msg_type)
                remaining = None if deadline is None else deadline - time.monotonic_ns()
                if remaining is not None and remaining <= 0:
                    break
                event.wait(remaining)
    finally:
        subscription.close()
    return False, None
