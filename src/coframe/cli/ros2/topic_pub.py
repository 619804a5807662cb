# SPDX-License-Identifier: Apache-2.0
"""``coframe topic pub``: publishes messages that are written as YAML, like ``ros2 topic pub``."""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING, Annotated, Any

import typer

from coframe.cli.options import NonNegativeDuration, with_leading_slash
from coframe.cli.output import fail
from coframe.cli.ros2.graph import AT_ONCE, SimTimeOption, SpinTimeOption, graph_node, load_type
from coframe.cli.ros2.qos import (
    DepthOption,
    DurabilityOption,
    HistoryOption,
    ProfileOption,
    QoSWords,
    ReliabilityOption,
)
from coframe.cli.ros2.values import read_values

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.publisher import Publisher

__all__ = ["pub"]

_KEEP_ALIVE = NonNegativeDuration("100ms")
_LONGEST_PERIOD = 1e9  # seconds; Python cannot sleep for more than nine times as long
_POLL = 0.1  # seconds between two looks for matching subscriptions, as in ros2cli


def pub(
    topic_name: Annotated[
        str, typer.Argument(metavar="TOPIC", help="Name of the topic, e.g. /chatter.", callback=with_leading_slash)
    ],
    message_type: Annotated[str, typer.Argument(metavar="TYPE", help="Type, e.g. std_msgs/msg/String.")],
    values: Annotated[
        str, typer.Argument(metavar="[VALUES]", help="Values of fields as YAML, e.g. '{data: hello}'.")
    ] = "{}",
    rate: Annotated[float, typer.Option("--rate", "-r", metavar="HZ", help="Messages per second.")] = 1.0,
    print_every: Annotated[
        int, typer.Option("--print", "-p", metavar="N", help="Print only every N-th message.", min=0)
    ] = 1,
    once: Annotated[bool, typer.Option("--once", "-1", help="Publish one message and exit.")] = False,
    times: Annotated[
        int,
        typer.Option(
            "--times",
            "-t",
            metavar="N",
            min=0,
            help="Publish N messages and exit. [default: no limit]",
            show_default=False,
        ),
    ] = 0,
    wait_matching: Annotated[
        int | None,
        typer.Option(
            "--wait-matching-subscriptions",
            "-w",
            metavar="N",
            min=0,
            help="Wait for N subscriptions first. [default: 1 with --once and --times, else 0]",
            show_default=False,
        ),
    ] = None,
    keep_alive: Annotated[
        NonNegativeDuration,
        typer.Option(
            "--keep-alive",
            metavar="DURATION",
            parser=NonNegativeDuration,
            help="Keep the node alive after the last message.",
        ),
    ] = _KEEP_ALIVE,
    node_name: Annotated[
        str | None, typer.Option("--node-name", "-n", metavar="NAME", help="Name of the publishing node.")
    ] = None,
    qos_profile: ProfileOption = None,
    qos_depth: DepthOption = None,
    qos_history: HistoryOption = None,
    qos_reliability: ReliabilityOption = None,
    qos_durability: DurabilityOption = None,
    use_sim_time: SimTimeOption = False,
    spin_time: SpinTimeOption = AT_ONCE,
) -> None:
    """Publish messages on a topic. In VALUES, "stamp: now" and "header: auto" stand for the current time.

    Example: coframe topic pub /chatter std_msgs/msg/String '{data: hello}' --rate 2
    """
    if not rate > 0:
        fail("rate must be greater than zero", code=2)
    count = 1 if once else times
    with graph_node(spin_time, use_sim_time=use_sim_time, name=node_name or f"_coframe_pub_{os.getpid()}") as node:
        from rosidl_runtime_py.utilities import get_message  # noqa: PLC0415 - slow import

        message = load_type(message_type, get_message)()
        fill_stamps = read_values(message, values)
        qos = QoSWords(qos_profile, qos_depth, qos_history, qos_reliability, qos_durability).to_profile()
        publisher = node.create_publisher(type(message), topic_name, qos)
        _wait_for_subscriptions(publisher, (1 if count else 0) if wait_matching is None else wait_matching)
        _publish(node, publisher, message, fill_stamps, min(1.0 / rate, _LONGEST_PERIOD), print_every, count)
        time.sleep(keep_alive.seconds)


def _wait_for_subscriptions(publisher: Publisher, number: int) -> None:
    while publisher.get_subscription_count() < number:
        print(f"Waiting for at least {number} matching subscription(s)...", flush=True)
        deadline = time.monotonic() + 1.0
        while publisher.get_subscription_count() < number and time.monotonic() < deadline:
            time.sleep(_POLL)


def _publish(
    node: Node, publisher: Publisher, message: Any, fill_stamps: Any, period: float, print_every: int, count: int
) -> None:
    print("publisher: beginning loop", flush=True)
    due = time.monotonic()
    number = 0
    while not count or number < count:
        number += 1
        fill_stamps(node.get_clock().now().to_msg())
        if print_every and number % print_every == 0:
            print(f"publishing #{number}: {message!r}\n", flush=True)
        publisher.publish(message)
        due += period
        if number != count:
            time.sleep(max(0.0, due - time.monotonic()))
