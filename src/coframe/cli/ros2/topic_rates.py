# SPDX-License-Identifier: Apache-2.0
"""``coframe topic hz``, ``bw`` and ``delay``: statistics of a topic, printed every second as by ``ros2 topic``."""

from __future__ import annotations

import itertools
import statistics
import time
from collections import deque
from typing import TYPE_CHECKING, Any

import click

from coframe.cli.output import fail
from coframe.cli.ros2.graph import (
    AT_ONCE,
    GraphCommand,
    graph_node,
    load_type,
    sim_time_option,
    spin_time_option,
    topic_argument,
    topic_type,
)
from coframe.cli.ros2.messages import MessageStream, message_filter
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.cli.declaration import Declared
    from coframe.cli.options import NonNegativeDuration
    from rclpy.node import Node

__all__ = ["bw", "delay", "hz"]

_KILO = 1000  # ros2cli prints decimal units


def window_option(default: int) -> Callable[[Declared], Declared]:
    """Declare the option `--window`.

    Args:
        default: The number of messages that ros2cli uses.
    """
    return click.option(
        "--window",
        "-w",
        metavar="N",
        type=click.IntRange(min=2, max=10_000_000),
        default=default,
        help="Number of messages in the statistics window.",
    )


@click.command(cls=GraphCommand, short_help="Show the rate of a topic.")
@topic_argument
@window_option(10_000)
@click.option(
    "--filter",
    "filter_expression",
    metavar="EXPR",
    help="Count only messages m for which this Python expression is true.",
)
@click.option("--wall-time", is_flag=True, help="Use the system time instead of /clock.")
@sim_time_option
@spin_time_option(AT_ONCE)
def hz(
    topic_name: str,
    window: int,
    filter_expression: str | None,
    wall_time: bool,
    use_sim_time: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Show the rate of messages on a topic: mean rate, minimum and maximum period, and standard deviation.

    Example: coframe topic hz /scan
    """
    accepts = message_filter(filter_expression)
    with graph_node(spin_time, use_sim_time=use_sim_time and not wall_time) as node:
        stream = _stream(node, topic_name, raw=filter_expression is None)
        arrivals: deque[float] = deque(maxlen=window)
        _report_every_second(
            stream,
            lambda message: arrivals.append(_now(node)) if accepts(message) else None,
            lambda: _rate_lines(list(arrivals)),
        )


@click.command(cls=GraphCommand, short_help="Show the bandwidth of a topic.")
@topic_argument
@window_option(100)
@sim_time_option
@spin_time_option(AT_ONCE)
def bw(
    topic_name: str,
    window: int,
    use_sim_time: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Show the bandwidth of a topic in bytes per second, and the sizes of its messages.

    Example: coframe topic bw /camera/image_raw
    """
    with graph_node(spin_time, use_sim_time=use_sim_time) as node:
        stream = _stream(node, topic_name, raw=True)
        print(f"Subscribed to [{topic_name}]", flush=True)
        samples: deque[tuple[float, int]] = deque(maxlen=window)
        _report_every_second(
            stream,
            lambda data: samples.append((time.monotonic(), len(data))),
            lambda: _bandwidth_lines(list(samples), time.monotonic()),
        )


@click.command(cls=GraphCommand, short_help="Show the time from header stamp to arrival.")
@topic_argument
@window_option(10_000)
@sim_time_option
@spin_time_option(AT_ONCE)
def delay(
    topic_name: str,
    window: int,
    use_sim_time: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Show the time from the header stamp of each message to its arrival.

    Example: coframe topic delay /scan
    """
    with graph_node(spin_time, use_sim_time=use_sim_time) as node:
        stream = _stream(node, topic_name, raw=False)
        delays: deque[float] = deque(maxlen=window)

        def store(message: Any) -> None:
            if not hasattr(message, "header"):
                fail("msg does not have header", f"The messages of {topic_name} have no stamp.")
            stamp = message.header.stamp
            delays.append(_now(node) - (stamp.sec + stamp.nanosec / SECOND))

        _report_every_second(stream, store, lambda: _delay_lines(list(delays)))


def _stream(node: Node, topic: str, *, raw: bool) -> MessageStream:
    from rclpy.qos import qos_profile_sensor_data  # noqa: PLC0415 - slow import
    from rosidl_runtime_py.utilities import get_message  # noqa: PLC0415 - slow import

    kind = topic_type(node, topic, wait=True)
    # Best effort, as in ros2cli: it matches every publisher.
    return MessageStream(node, topic, load_type(kind, get_message), qos_profile_sensor_data, raw=raw)


def _now(node: Node) -> float:
    nanoseconds: int = node.get_clock().now().nanoseconds
    return nanoseconds / SECOND


def _report_every_second(stream: MessageStream, store: Callable[[Any], None], report: Callable[[], list[str]]) -> None:
    """Store each message, and print a report every second in which messages arrived."""
    due = time.monotonic() + 1.0
    arrived = 0
    while True:
        message = stream.take(max(0.0, due - time.monotonic()))
        if message is not None:
            store(message)
            arrived += 1
        if time.monotonic() < due:
            continue
        due += 1.0
        lines = report() if arrived else ["no new messages"]
        arrived = 0
        if lines:
            print("\n".join(lines), flush=True)


def _rate_lines(arrivals: list[float]) -> list[str]:
    periods = [later - earlier for earlier, later in itertools.pairwise(arrivals)]
    if not periods or sum(periods) <= 0:
        return []
    return [f"average rate: {len(periods) / sum(periods):.3f}", _statistics_line(periods, len(arrivals))]


def _delay_lines(delays: list[float]) -> list[str]:
    return [f"average delay: {statistics.fmean(delays):.3f}", _statistics_line(delays, len(delays))]


def _statistics_line(values: list[float], size: int) -> str:
    return f"\tmin: {min(values):.3f}s max: {max(values):.3f}s std dev: {statistics.pstdev(values):.5f}s window: {size}"


def _bandwidth_lines(samples: list[tuple[float, int]], now: float) -> list[str]:
    """Return the lines of ros2cli; the rate is computed since the oldest message in the window."""
    if len(samples) < 2 or now <= samples[0][0]:
        return []
    sizes = [size for _, size in samples]
    rate = sum(sizes) / (now - samples[0][0])
    # All sizes have the unit of their mean.
    divisor, unit = _unit(statistics.fmean(sizes))
    mean, least, most = (f"{value / divisor:.2f} {unit}" for value in (statistics.fmean(sizes), min(sizes), max(sizes)))
    rate_divisor, rate_unit = _unit(rate)
    return [
        f"{rate / rate_divisor:.2f} {rate_unit}/s from {len(samples)} messages",
        f"\tMessage size mean: {mean} min: {least} max: {most}",
    ]


def _unit(value: float) -> tuple[int, str]:
    if value < _KILO:
        return 1, "B"
    return (_KILO, "KB") if value < _KILO**2 else (_KILO**2, "MB")
