# SPDX-License-Identifier: Apache-2.0
"""Function that waits for a single message."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING, Any

from coframe._core import Event
from coframe.messages import codec
from rclpy import _absent
from rclpy._numbers import require_number
from rclpy.constants import S_TO_NS
from rclpy.qos import QoSProfile, as_qos_profile

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
    """Wait for the next message on a topic.

    Args:
        msg_type: Class of the message.
        node: Node that subscribes during the call. It does not need to be spinning.
        topic: Name of the topic.
        qos_profile: QoS profile of the subscription, or its depth.
        time_to_wait: Maximum time to wait in seconds. Negative: no limit.

    Returns:
        (True, message), or (False, None) after a timeout or the shutdown of the context.
    """
    deadline = None if time_to_wait < 0 else time.monotonic_ns() + int(require_number(time_to_wait) * S_TO_NS)
    event = Event()
    name, qos = node.resolve_topic_name(topic), as_qos_profile(qos_profile)._Coframe__to_wire()
    subscription = node._Coframe__participant.subscription(
        node._Coframe__graph_node, name, msg_type, qos, on_data=event
    )
    try:
        with node.context._Coframe__shutdown.wakes(event):
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


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
