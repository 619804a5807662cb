# SPDX-License-Identifier: Apache-2.0
"""``coframe topic hz``, ``bw`` and ``delay``: statistics of a topic, printed every second as by ``ros2 topic``."""

from __future__ import annotations

import itertools
import statistics
import time
from collections import deque
from typing import TYPE_CHECKING, Any

import click

from coframe.cli.completion import complete_live_topics
from coframe.cli.declaration import argument
from coframe.cli.options import topic_name
from coframe.cli.output import fail, one_line
from coframe.cli.ros2.graph import (
    DISCOVERY_TIME,
    NO_WAIT,
    GraphCommand,
    graph_node,
    load_type,
    sim_time_option,
    spin_time_option,
    topic_argument,
    topic_type,
    wait_until,
)
from coframe.cli.ros2.hidden_names import is_hidden
from coframe.cli.ros2.messages import MessageStream, message_filter
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.cli.declaration import Declared
    from coframe.cli.options import NonNegativeDuration
    from rclpy.node import Node

__all__ = ["bw", "delay", "hz"]

_KILO = 1000  # ros2cli prints decimal units
_RATE_COLUMNS = ("topic", "rate", "min_delta", "max_delta", "std_dev", "window")
_SIZE_COLUMNS = ("topic", "rate", "mean", "min", "max", "window")

topics_argument = argument(
    "topic_names",
    metavar="[TOPIC]...",
    type=topic_name,
    nargs=-1,
    shell_complete=complete_live_topics,
    help="Names of topics, e.g. /scan.",
)
all_topics_option = click.option("--all", "-a", "all_topics", is_flag=True, help="Show all topics that are not hidden.")


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


@click.command(cls=GraphCommand, short_help="Show the rates of topics.")
@topics_argument
@all_topics_option
@window_option(10_000)
@click.option(
    "--filter",
    "filter_expression",
    metavar="EXPR",
    help="Count only messages m for which this Python expression is true.",
)
@click.option("--wall-time", is_flag=True, help="Use the system time instead of /clock.")
@sim_time_option
@spin_time_option(NO_WAIT)
def hz(
    topic_names: tuple[str, ...],
    all_topics: bool,
    window: int,
    filter_expression: str | None,
    wall_time: bool,
    use_sim_time: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Show the rate of messages on topics: mean rate, minimum and maximum period, and standard deviation.

    Example: coframe topic hz /scan
    """
    _check_topics(topic_names, all_topics=all_topics)
    accepts = message_filter(filter_expression)
    with graph_node(spin_time, use_sim_time=use_sim_time and not wall_time) as node:
        stream, topics = _stream(node, topic_names, raw=filter_expression is None)
        arrivals: dict[str, deque[float]] = {topic: deque(maxlen=window) for topic in topics}
        _report_every_second(
            stream,
            lambda topic, message: arrivals[topic].append(_now(node)) if accepts(message) else None,
            lambda: (
                _rate_lines(list(arrivals[topics[0]]))
                if len(topics) == 1
                else _table(_RATE_COLUMNS, {topic: _rates(list(times)) for topic, times in arrivals.items()})
            ),
        )


@click.command(cls=GraphCommand, short_help="Show the bandwidth of topics.")
@topics_argument
@all_topics_option
@window_option(100)
@sim_time_option
@spin_time_option(NO_WAIT)
def bw(
    topic_names: tuple[str, ...],
    all_topics: bool,
    window: int,
    use_sim_time: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Show the bandwidth of topics in bytes per second, and the sizes of their messages.

    Example: coframe topic bw /camera/image_raw
    """
    _check_topics(topic_names, all_topics=all_topics)
    with graph_node(spin_time, use_sim_time=use_sim_time) as node:
        stream, topics = _stream(node, topic_names, raw=True)
        print(f"Subscribed to [{', '.join(map(one_line, topics))}]", flush=True)
        samples: dict[str, deque[tuple[float, int]]] = {topic: deque(maxlen=window) for topic in topics}

        def report() -> list[str]:
            now = time.monotonic()
            if len(topics) == 1:
                return _bandwidth_lines(list(samples[topics[0]]), now)
            return _table(_SIZE_COLUMNS, {topic: _bandwidths(list(each), now) for topic, each in samples.items()})

        _report_every_second(stream, lambda topic, data: samples[topic].append((time.monotonic(), len(data))), report)


@click.command(cls=GraphCommand, short_help="Show the time from header stamp to arrival.")
@topic_argument
@window_option(10_000)
@sim_time_option
@spin_time_option(NO_WAIT)
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
        stream, _ = _stream(node, (topic_name,), raw=False)
        delays: deque[float] = deque(maxlen=window)

        def store(_topic: str, message: Any) -> None:
            if not hasattr(message, "header"):
                fail("msg does not have header", f"The messages of {topic_name} have no stamp.")
            stamp = message.header.stamp
            delays.append(_now(node) - (stamp.sec + stamp.nanosec / SECOND))

        _report_every_second(stream, store, lambda: _delay_lines(list(delays)))


def _check_topics(topics: tuple[str, ...], *, all_topics: bool) -> None:
    """End the command unless either topics or --all are given."""
    if bool(topics) == all_topics:
        fail("TOPIC and --all are mutually exclusive", "Example: coframe topic hz /scan /odom", code=2)


def _stream(node: Node, names: tuple[str, ...], *, raw: bool) -> tuple[MessageStream, list[str]]:
    """Return a stream of the messages of topics, and their names. No names: all topics that are not hidden."""
    from rclpy.qos import qos_profile_sensor_data  # noqa: PLC0415 - slow import
    from rosidl_runtime_py.utilities import get_message  # noqa: PLC0415 - slow import

    stream = MessageStream(node)
    topics = list(dict.fromkeys(names)) or _published_topics(node)
    for topic in topics:
        kind = topic_type(node, topic, wait=True)
        # Best effort, as in ros2cli: it matches every publisher.
        stream.subscribe(topic, load_type(kind, get_message), qos_profile_sensor_data, raw=raw)
    return stream, topics


def _published_topics(node: Node) -> list[str]:
    """Return the topics of the graph, or end the command if there are none."""
    topics: list[str] = wait_until(
        lambda: sorted(name for name, _ in node.get_topic_names_and_types() if not is_hidden(name))
    )
    if not topics:
        fail("There are no topics.", "coframe topic list --include-hidden-topics shows all topics.")
    time.sleep(DISCOVERY_TIME.seconds)
    return sorted(name for name, _ in node.get_topic_names_and_types() if not is_hidden(name))


def _now(node: Node) -> float:
    nanoseconds: int = node.get_clock().now().nanoseconds
    return nanoseconds / SECOND


def _report_every_second(
    stream: MessageStream, store: Callable[[str, Any], None], report: Callable[[], list[str]]
) -> None:
    """Store each message, and print a report every second in which messages arrived."""
    due = time.monotonic() + 1.0
    arrived = 0
    while True:
        arrival = stream.take_labeled(max(0.0, due - time.monotonic()))
        if arrival is not None:
            store(*arrival)
            arrived += 1
        if time.monotonic() < due:
            continue
        due += 1.0
        lines = report() if arrived else ["no new messages"]
        arrived = 0
        if lines:
            print("\n".join(lines), flush=True)


def _periods(arrivals: list[float]) -> list[float]:
    """Return the times between arrivals; none if the clock does not move."""
    periods = [later - earlier for earlier, later in itertools.pairwise(arrivals)]
    return periods if sum(periods) > 0 else []


def _rate_lines(arrivals: list[float]) -> list[str]:
    periods = _periods(arrivals)
    if not periods:
        return []
    return [f"average rate: {len(periods) / sum(periods):.3f}", _statistics_line(periods, len(arrivals))]


def _rates(arrivals: list[float]) -> list[str]:
    """Return the cells of a topic in the table of rates, or no cells if there are too few messages."""
    periods = _periods(arrivals)
    if not periods:
        return []
    figures = (len(periods) / sum(periods), min(periods), max(periods))
    return [*(f"{figure:.3f}" for figure in figures), f"{statistics.pstdev(periods):.5f}", str(len(arrivals))]


def _delay_lines(delays: list[float]) -> list[str]:
    return [f"average delay: {statistics.fmean(delays):.3f}", _statistics_line(delays, len(delays))]


def _statistics_line(values: list[float], size: int) -> str:
    return f"\tmin: {min(values):.3f}s max: {max(values):.3f}s std dev: {statistics.pstdev(values):.5f}s window: {size}"


def _bandwidths(samples: list[tuple[float, int]], now: float) -> list[str]:
    """Return the cells of a topic in the table of bandwidths, or no cells if there are too few messages.

    The rate is computed since the oldest message in the window, and all sizes have the unit of their mean.
    """
    if len(samples) < 2 or now <= samples[0][0]:
        return []
    sizes = [size for _, size in samples]
    rate = sum(sizes) / (now - samples[0][0])
    divisor, unit = _unit(statistics.fmean(sizes))
    figures = (f"{value / divisor:.2f} {unit}" for value in (statistics.fmean(sizes), min(sizes), max(sizes)))
    rate_divisor, rate_unit = _unit(rate)
    return [f"{rate / rate_divisor:.2f} {rate_unit}/s", *figures, str(len(samples))]


def _bandwidth_lines(samples: list[tuple[float, int]], now: float) -> list[str]:
    """Return the lines of ros2cli about one topic."""
    cells = _bandwidths(samples, now)
    if not cells:
        return []
    rate, mean, least, most, number = cells
    return [f"{rate} from {number} messages", f"\tMessage size mean: {mean} min: {least} max: {most}"]


def _table(columns: tuple[str, ...], rows: dict[str, list[str]]) -> list[str]:
    """Return the table of ros2cli about several topics; topics with too few messages are omitted."""
    cells = [[one_line(topic), *row] for topic, row in rows.items() if row]
    if not cells:
        return ["no new messages"]
    widths = [max(map(len, column)) for column in zip(columns, *cells, strict=True)]
    return [
        "   ".join(title.center(width) for title, width in zip(columns, widths, strict=True)),
        "=" * (sum(widths) + 3 * (len(columns) - 1)),
        *("   ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in cells),
        "",
    ]


def _unit(value: float) -> tuple[int, str]:
    if value < _KILO:
        return 1, "B"
    return (_KILO, "KB") if value < _KILO**2 else (_KILO**2, "MB")
