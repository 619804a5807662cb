# SPDX-License-Identifier: Apache-2.0
"""``coframe topic``: the topics of the ROS graph, with the same names and output as ``ros2 topic``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click
from click.exceptions import Exit

from coframe.cli.declaration import CommandGroup, argument
from coframe.cli.output import fail, one_line, printable
from coframe.cli.ros2.graph import (
    DISCOVERY_TIME,
    NO_WAIT,
    GraphCommand,
    graph_node,
    hidden_topics_option,
    join_types,
    spin_time_option,
    topic_argument,
    wait_until,
)
from coframe.cli.ros2.hidden_names import is_hidden
from coframe.cli.ros2.topic_echo import echo
from coframe.cli.ros2.topic_pub import pub
from coframe.cli.ros2.topic_rates import bw, delay, hz

if TYPE_CHECKING:
    from coframe.cli.options import NonNegativeDuration
    from rclpy.node import Node

__all__ = ["topic"]

topic = CommandGroup(
    "topic",
    help="Inspect and publish topics, like ros2 topic.\n\nExample: coframe topic echo /scan",
)
topic.add_command(bw)
topic.add_command(delay)
topic.add_command(echo)


@topic.command(cls=GraphCommand, short_help="List the topics of a type.")
@argument("topic_type", metavar="TYPE", help="Type, e.g. sensor_msgs/msg/LaserScan.")
@click.option("--count-topics", "-c", "count", is_flag=True, help="Print only the number of topics.")
@hidden_topics_option
@spin_time_option(DISCOVERY_TIME)
def find(
    topic_type: str,
    count: bool,
    include_hidden: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """List the topics of a type.

    Example: coframe topic find sensor_msgs/msg/LaserScan
    """
    with graph_node(spin_time) as node:
        names = [name for name, types in _topics(node, include_hidden=include_hidden) if topic_type in types]
    print(len(names) if count else "\n".join(map(one_line, names)))


topic.add_command(hz)


@topic.command(cls=GraphCommand, short_help="Show the type, publishers and subscriptions of a topic.")
@topic_argument
@click.option(
    "--verbose", "-v", is_flag=True, help="Show the node, type, GID and QoS of each publisher and subscription."
)
@spin_time_option(DISCOVERY_TIME)
def info(
    topic_name: str,
    verbose: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Show the type of a topic, and how many publishers and subscriptions it has.

    Example: coframe topic info /tf --verbose
    """
    end = "\n\n" if verbose else "\n"
    with graph_node(spin_time) as node:
        types = wait_until(lambda: dict(node.get_topic_names_and_types()).get(topic_name))
        if not types:
            fail(f"Unknown topic '{topic_name}'", "coframe topic list shows all topics.")
        print(f"Type: {one_line(types[0] if len(types) == 1 else str(types))}", end=end)
        print(f"Publisher count: {node.count_publishers(topic_name)}", end=end)
        for endpoint in node.get_publishers_info_by_topic(topic_name) if verbose else ():
            print(printable(str(endpoint)), end=end)
        print(f"Subscription count: {node.count_subscribers(topic_name)}", end=end)
        for endpoint in node.get_subscriptions_info_by_topic(topic_name) if verbose else ():
            print(printable(str(endpoint)), end=end)


@topic.command("list", cls=GraphCommand, short_help="List the topics.")
@click.option("--show-types", "-t", is_flag=True, help="Also show the types.")
@click.option("--count-topics", "-c", "count", is_flag=True, help="Print only the number of topics.")
@click.option(
    "--verbose", "-v", is_flag=True, help="Also show the types and the numbers of publishers and subscriptions."
)
@hidden_topics_option
@spin_time_option(DISCOVERY_TIME)
def list_topics(
    show_types: bool,
    count: bool,
    verbose: bool,
    include_hidden: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """List the topics of the ROS graph.

    Example: coframe topic list -t
    """
    with graph_node(spin_time) as node:
        topics = _topics(node, include_hidden=include_hidden)
        if count:
            print(len(topics))
        elif verbose:
            _print_counts("PublishResult", "publisher", [(*each, node.count_publishers(each[0])) for each in topics])
            _print_counts("Subscribed", "subscriber", [(*each, node.count_subscribers(each[0])) for each in topics])
        else:
            for name, types in topics:
                print(one_line(f"{name} {join_types(types)}" if show_types else name))


topic.add_command(pub)


@topic.command("type", cls=GraphCommand, short_help="Print the type of a topic.")
@topic_argument
@spin_time_option(NO_WAIT)
def type_(topic_name: str, spin_time: NonNegativeDuration) -> None:
    """Print the type of a topic. The exit code is 1 if the topic is unknown.

    Example: coframe topic type /tf
    """
    with graph_node(spin_time) as node:
        types = wait_until(lambda: dict(node.get_topic_names_and_types()).get(topic_name))
    if not types:
        raise Exit(1)
    print("\n".join(map(one_line, types)))


def _topics(node: Node, *, include_hidden: bool) -> list[tuple[str, list[str]]]:
    topics = sorted(node.get_topic_names_and_types())
    return [each for each in topics if include_hidden or not is_hidden(each[0])]


def _print_counts(title: str, noun: str, topics: list[tuple[str, list[str], int]]) -> None:
    print(f"{title} topics:")
    for name, types, number in topics:
        if number:
            print(one_line(f" * {name} {join_types(types)} {number} {noun}{'' if number == 1 else 's'}"))
    print()
