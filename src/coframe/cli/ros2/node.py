# SPDX-License-Identifier: Apache-2.0
"""``coframe node``: the nodes of the ROS graph, with the same names and output as ``ros2 node``."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from coframe.cli.declaration import CommandGroup
from coframe.cli.output import one_line
from coframe.cli.ros2.graph import (
    DISCOVERY_TIME,
    GraphCommand,
    all_option,
    fail_without_node,
    graph_node,
    node_argument,
    node_names,
    spin_time_option,
    split_node_name,
    wait_until,
)
from coframe.cli.ros2.hidden_names import is_hidden

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.cli.options import NonNegativeDuration
    from rclpy.node import Node

__all__ = ["node"]

node = CommandGroup(
    "node",
    help="List and inspect nodes, like ros2 node.\n\nExample: coframe node info /dynamic_tf_broadcaster",
)


@node.command("list", cls=GraphCommand, short_help="List the nodes.")
@all_option
@click.option("--count-nodes", "-c", "count", is_flag=True, help="Print only the number of nodes.")
@spin_time_option(DISCOVERY_TIME)
def list_nodes(
    include_hidden: bool,
    count: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """List the nodes of the ROS graph.

    Example: coframe node list
    """
    with graph_node(spin_time) as own:
        names = node_names(own, include_hidden=include_hidden)
    if count:
        print(len(names))
        return
    if len(set(names)) < len(names):
        print(
            "WARNING: Be aware that there are nodes in the graph that share an exact name, "
            "which can have unintended side effects.",
            file=sys.stderr,
        )
    for name in names:
        print(one_line(name))


@node.command(cls=GraphCommand, short_help="Show the topics, services and actions of a node.")
@node_argument
@click.option("--include-hidden", is_flag=True, help="Also show hidden topics, services and actions.")
@spin_time_option(DISCOVERY_TIME)
def info(
    node_name: str,
    include_hidden: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Show the subscriptions, publishers, services and actions of a node.

    Example: coframe node info /dynamic_tf_broadcaster
    """
    with graph_node(spin_time) as own:
        if not wait_until(lambda: node_name in node_names(own, include_hidden=True)):
            fail_without_node(own, f"Unable to find node '{node_name}'", node_name)
        print(one_line(node_name))
        for title, rows in _sections(own, node_name):
            print(f"  {title}:")
            for name, types in rows:
                if include_hidden or not is_hidden(name):
                    print(one_line(f"    {name}: {', '.join(types)}"))
        print()


def _sections(own_node: Node, node_name: str) -> Iterator[tuple[str, list[tuple[str, list[str]]]]]:
    """Yield the titles and rows of `ros2 node info`, in its order."""
    from rclpy.action import (  # noqa: PLC0415 - slow import
        get_action_client_names_and_types_by_node,
        get_action_server_names_and_types_by_node,
    )

    namespace, name = split_node_name(node_name)
    yield "Subscribers", sorted(own_node.get_subscriber_names_and_types_by_node(name, namespace))
    yield "Publishers", sorted(own_node.get_publisher_names_and_types_by_node(name, namespace))
    yield "Service Servers", sorted(own_node.get_service_names_and_types_by_node(name, namespace))
    yield "Service Clients", sorted(own_node.get_client_names_and_types_by_node(name, namespace))
    yield "Action Servers", sorted(get_action_server_names_and_types_by_node(own_node, name, namespace))
    yield "Action Clients", sorted(get_action_client_names_and_types_by_node(own_node, name, namespace))
