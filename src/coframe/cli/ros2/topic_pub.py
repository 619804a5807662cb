# SPDX-License-Identifier: Apache-2.0
"""``coframe topic pub``: publishes messages written as YAML, like ``ros2 topic pub``."""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from coframe.cli.declaration import PATH, argument
from coframe.cli.options import NonNegativeDuration, topic_name
from coframe.cli.output import fail, warn
from coframe.cli.ros2.graph import (
    ENDPOINT_TIMEOUT,
    NO_WAIT,
    GraphCommand,
    graph_node,
    load_type,
    sim_time_option,
    spin_time_option,
)
from coframe.cli.ros2.qos import (
    QoSWords,
    depth_option,
    durability_option,
    history_option,
    profile_option,
    reliability_option,
)
from coframe.cli.ros2.values import read_documents, read_values
from coframe.messages.message import complete_repr

if TYPE_CHECKING:
    from pathlib import Path

    from rclpy.node import Node
    from rclpy.publisher import Publisher

__all__ = ["pub"]

_MAX_PERIOD = 1e9  # seconds; close to the longest time that Python can sleep
_POLL = 0.1  # seconds between two looks for matching subscriptions, as in ros2cli


@click.command(cls=GraphCommand, short_help="Publish messages on a topic.")
@argument("topic_name", metavar="TOPIC", type=topic_name, help="Name of the topic, e.g. /chatter.")
@argument("message_type", metavar="TYPE", help="Type, e.g. std_msgs/msg/String.")
@argument("values", metavar="[VALUES]", required=False, help="Values of fields as YAML, e.g. '{data: hello}'.")
@click.option(
    "--yaml-file",
    metavar="FILE",
    type=PATH,
    help="Publish the messages of a YAML file once, such as the output of topic echo, instead of VALUES.",
)
@click.option("--rate", "-r", metavar="HZ", type=float, default=1.0, help="Messages per second.")
@click.option(
    "--print",
    "-p",
    "print_every",
    metavar="N",
    type=click.IntRange(min=0),
    default=1,
    help="Print only every N-th message.",
)
@click.option("--once", "-1", is_flag=True, help="Publish one message and exit.")
@click.option(
    "--times",
    "-t",
    metavar="N",
    type=click.IntRange(min=0),
    default=0,
    show_default=False,
    help="Publish N messages and exit. [default: no limit]",
)
@click.option(
    "--wait-matching-subscriptions",
    "-w",
    "wait_matching",
    metavar="N",
    type=click.IntRange(min=0),
    help="Wait for N matching subscriptions first. [default: 1 with --once and --times, else 0]",
)
@click.option(
    "--keep-alive",
    metavar="DURATION",
    type=NonNegativeDuration,
    default="100ms",
    help="How long to keep the node alive after the last message.",
)
@click.option("--node-name", "-n", metavar="NAME", help="Name of the publishing node.")
@profile_option
@depth_option
@history_option
@reliability_option
@durability_option
@sim_time_option
@spin_time_option(NO_WAIT)
def pub(
    topic_name: str,
    message_type: str,
    values: str | None,
    yaml_file: Path | None,
    rate: float,
    print_every: int,
    once: bool,
    times: int,
    wait_matching: int | None,
    keep_alive: NonNegativeDuration,
    node_name: str | None,
    qos_profile: str | None,
    qos_depth: int | None,
    qos_history: str | None,
    qos_reliability: str | None,
    qos_durability: str | None,
    use_sim_time: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Publish messages on a topic. In VALUES, "stamp: now" and "header: auto" insert the current time.

    Example: coframe topic pub /chatter std_msgs/msg/String '{data: hello}' --rate 2
    """
    if not rate > 0:
        fail("rate must be greater than zero", code=2)
    if values is not None and yaml_file is not None:
        fail("VALUES and --yaml-file cannot be combined", code=2)
    count = 1 if once else times
    with graph_node(spin_time, use_sim_time=use_sim_time, name=node_name or f"_coframe_pub_{os.getpid()}") as node:
        from rclpy.duration import Duration  # noqa: PLC0415 - slow import
        from rosidl_runtime_py.utilities import get_message  # noqa: PLC0415 - slow import

        kind = load_type(message_type, get_message)
        texts = [values or "{}"] if yaml_file is None else read_documents(yaml_file)
        messages = [_Message.read(kind, text) for text in texts]
        qos = QoSWords(qos_profile, qos_depth, qos_history, qos_reliability, qos_durability).to_profile()
        if yaml_file is not None:
            count = min(count or len(messages), len(messages))
        publisher = node.create_publisher(kind, topic_name, qos)
        _wait_for_subscriptions(publisher, (1 if count else 0) if wait_matching is None else wait_matching)
        _publish(node, publisher, messages, min(1.0 / rate, _MAX_PERIOD), print_every, count)
        if not publisher.wait_for_all_acked(Duration(seconds=ENDPOINT_TIMEOUT)):
            warn(f"not all subscriptions confirmed all messages within {ENDPOINT_TIMEOUT:g} s")
        time.sleep(keep_alive.seconds)


class _Message(NamedTuple):
    """A message to publish, and the function that sets its stamps."""

    message: Any
    fill_stamps: Any

    @classmethod
    def read(cls, kind: Any, text: str) -> _Message:
        """Return a message with the values of a YAML document."""
        message = kind()
        return cls(message, read_values(message, text))


def _wait_for_subscriptions(publisher: Publisher, number: int) -> None:
    while publisher.get_subscription_count() < number:
        print(f"Waiting for at least {number} matching subscription(s)...", flush=True)
        deadline = time.monotonic() + 1.0
        while publisher.get_subscription_count() < number and time.monotonic() < deadline:
            time.sleep(_POLL)


def _publish(
    node: Node, publisher: Publisher, messages: list[_Message], period: float, print_every: int, count: int
) -> None:
    print("publisher: beginning loop", flush=True)
    due = time.monotonic()
    number = 0
    while not count or number < count:
        message, fill_stamps = messages[number % len(messages)]
        number += 1
        fill_stamps(node.get_clock().now().to_msg())
        if print_every and number % print_every == 0:
            print(f"publishing #{number}: {complete_repr(message)}\n", flush=True)
        publisher.publish(message)
        due += period
        if number != count:
            time.sleep(max(0.0, due - time.monotonic()))
