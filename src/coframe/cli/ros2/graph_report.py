# SPDX-License-Identifier: Apache-2.0
"""The part of ``coframe doctor --report`` about the ROS graph."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.cli.options import NonNegativeDuration
from coframe.cli.output import one_line, report_console
from coframe.cli.ros2.graph import graph_node, join_types, node_names

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rclpy.node import Node

__all__ = ["print_graph"]

_DISCOVERY = NonNegativeDuration("2s")


def print_graph() -> None:
    """Print the nodes, topics, services and actions of the graph, and publishers with an incompatible QoS."""
    with graph_node(_DISCOVERY) as node:
        sections = {
            "Nodes": node_names(node, include_hidden=False),
            "Topics": list(_topics(node)),
            "Incompatible QoS": list(_incompatibility_lines(node)),
            "Services": list(_services(node)),
            "Actions": list(_actions(node)),
        }
    console = report_console()
    for title, lines in sections.items():
        console.print(f"{title}: {len(lines)}", style="bold", markup=False)
        for line in lines:
            console.print(f"  {one_line(line)}", markup=False, highlight=False)


def _topics(node: Node) -> Iterator[str]:
    for name, types in sorted(node.get_topic_names_and_types()):
        counts = f"{node.count_publishers(name)} publishers, {node.count_subscribers(name)} subscriptions"
        yield f"{name} {join_types(types)}: {counts}"


def _incompatibility_lines(node: Node) -> Iterator[str]:
    """Yield a line for each publisher and subscription of a topic that cannot communicate."""
    from rclpy.qos import QoSCompatibility, qos_check_compatible  # noqa: PLC0415 - slow import

    for name, _ in sorted(node.get_topic_names_and_types()):
        for publisher in node.get_publishers_info_by_topic(name):
            for subscription in node.get_subscriptions_info_by_topic(name):
                result, reason = qos_check_compatible(publisher.qos_profile, subscription.qos_profile)
                if result == QoSCompatibility.ERROR:
                    yield f"{name}: from {publisher.node_name} to {subscription.node_name}: {reason.strip()}"


def _services(node: Node) -> Iterator[str]:
    for name, types in sorted(node.get_service_names_and_types()):
        yield f"{name} {join_types(types)}: {node.count_services(name)} servers, {node.count_clients(name)} clients"


def _actions(node: Node) -> Iterator[str]:
    from rclpy.action import get_action_names_and_types  # noqa: PLC0415 - slow import

    for name, types in sorted(get_action_names_and_types(node)):
        yield f"{name} {join_types(types)}"
