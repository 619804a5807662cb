# SPDX-License-Identifier: Apache-2.0
"""Warn about a node whose middleware sends requests and replies in another form."""

from __future__ import annotations

from typing import Final

from coframe.wire import names, selection, vendors

_FAST_DDS_WIRE: Final = "fastdds"


def foreign_services_text(topic: str, middleware: str, node: str | None, *, is_writer: bool) -> str:
    """Return the warning.

    Args:
        topic: The DDS topic of the requests or replies.
        middleware: The middleware of the other node.
        node: The name of the other node, or None if it is unknown.
        is_writer: Whether this process publishes on the topic.
    """
    service = names.any_ros_name(topic)
    serves = names.ros_topic(topic, "reply" if is_writer else "request") is not None
    effect = "its calls of {} do not arrive" if serves else "its service {} cannot be called"
    who = f"Node {node}" if node else "An unnamed node"
    return (
        f"{who} uses {middleware}, so {effect.format(service)}: services, actions and parameters need the same "
        "middleware on both sides, and coframe uses Cyclone DDS. Start that node with "
        f"RMW_IMPLEMENTATION=rmw_cyclonedds_cpp.{_fast_dds_hint() if middleware == vendors.FAST_DDS else ''} Or use "
        "Zenoh for both: RMW_IMPLEMENTATION=rmw_zenoh_cpp there, and --wire zenoh or COFRAME_WIRE=zenoh here. Topics "
        "and transforms work."
    )


def _fast_dds_hint() -> str:
    """Return how to use coframe on Fast DDS, whose services work with both implementations of DDS."""
    if _FAST_DDS_WIRE in selection.wires():
        return f" Or start this program with {selection.VARIABLE}={_FAST_DDS_WIRE}."
    return (
        f" Or start this program with {selection.VARIABLE}={_FAST_DDS_WIRE}, after installing coframe-fastdds: pip "
        "install ./middlewares/fastdds in a checkout of coframe."
    )
