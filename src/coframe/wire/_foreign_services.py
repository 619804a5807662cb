# SPDX-License-Identifier: Apache-2.0
"""Warn about a node whose middleware sends requests and replies in another form."""

from __future__ import annotations

from coframe.wire import names


def foreign_services_text(topic: str, middleware: str, node: str | None, *, is_writer: bool) -> str:
    """Return the warning.

    Args:
        topic: The DDS topic of the requests or replies.
        middleware: The middleware of the other node.
        node: The name of the other node; None if it is unknown.
        is_writer: Whether this process publishes on the topic.
    """
    service = names.any_ros_name(topic)
    serves = names.ros_topic(topic, "reply" if is_writer else "request") is not None
    effect = "its calls of {} do not arrive" if serves else "its service {} cannot be called"
    who = f"Node {node}" if node else "An unnamed node"
    return (
        f"{who} uses {middleware}, so {effect.format(service)}: services, actions and parameters need the same "
        "middleware on both sides, and coframe uses Cyclone DDS. Start that node with "
        "RMW_IMPLEMENTATION=rmw_cyclonedds_cpp. Topics and transforms work. With the package coframe-fastdds, "
        "COFRAME_WIRE=fastdds makes services work with both."
    )
