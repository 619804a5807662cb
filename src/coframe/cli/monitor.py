# SPDX-License-Identifier: Apache-2.0
"""``coframe monitor``: shows the statistics of tf2_monitor for each edge and publisher."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any, NoReturn

import click
from rich.console import Group
from rich.live import Live
from rich.table import Table
from rich.text import Text

from coframe._output.escaping import display_name
from coframe._output.formatting import count
from coframe.cli.declaration import argument
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    PositiveDuration,
    domain_option,
    listener_options,
)
from coframe.cli.output import fail, report_console
from coframe.cli.ros_arguments import NodeCommand, node_identity
from coframe.connection.listener_config import ListenerConfig
from coframe.doctor.statistics import chain_statistics, edge_statistics, publisher_statistics
from coframe.time import MILLISECOND, SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import TypeAlias

    from coframe.doctor import Observation
    from coframe.doctor.live import LiveObserver
    from coframe.doctor.statistics import ChainStatistics

    Pair: TypeAlias = tuple[str, str] | None

__all__ = ["monitor"]

_MIN_ROWS = 5
_RESERVED_LINES = 12  # lines reserved on the screen for titles, a chain, and publishers
_BROADCASTERS = "\nAll Broadcasters:"


@click.command(cls=NodeCommand)
@argument("target", metavar="[TARGET", required=False, help="Show the chain between TARGET and SOURCE.")
@argument("source", metavar="SOURCE]", required=False, help="The second frame of the chain.")
@click.option("--once", is_flag=True, help="Print one report after --duration and exit.")
@click.option("--json", "as_json", is_flag=True, help="Print one line of JSON per report; times are in nanoseconds.")
@click.option("--classic", is_flag=True, help="Print in the format of ROS 2's tf2_monitor.")
@click.option(
    "--duration", metavar="DURATION", type=PositiveDuration, default="10s", help="Time window of the statistics."
)
@domain_option
@listener_options
def monitor(
    target: str | None,
    source: str | None,
    once: bool,
    as_json: bool,
    classic: bool,
    duration: PositiveDuration,
    domain: int | None,
    tf_topic: str,
    tf_static_topic: str,
    prefix: str,
    keep: str,
) -> None:
    """Show the rate, jitter, delay and age of each edge and publisher, and which edge limits a chain.

    Arguments after --ros-args remap the node and the topics: -r __node:=NAME, -r /tf:=TOPIC.

    Example: coframe monitor map base_link --once
    """
    if (target is None) != (source is None):
        fail("SOURCE is missing", "Give two frames, TARGET and SOURCE, or none.", code=2)
    if as_json and classic:
        fail("--json cannot be combined with --classic", code=2)
    pair = (target, source) if target is not None and source is not None else None
    with run_until_interrupted():
        from coframe.doctor.live import LiveObserver  # noqa: PLC0415 - slow import

        config = ListenerConfig.of(
            domain=domain, tf_topic=tf_topic, tf_static_topic=tf_static_topic, prefix=prefix, keep=keep
        )
        with LiveObserver(config, window=duration, **node_identity("coframe_monitor")) as observer:
            if classic:
                what = " -> ".join(pair) if pair else "all frames"
                print(f"Gathering data on {what} for {duration.seconds:g} seconds...", flush=True)
            if not (once or as_json or classic):
                _watch(observer, pair)
            _report(observer, pair, duration.seconds, _printer(as_json, classic), once=once)


def _printer(as_json: bool, classic: bool) -> Callable[[Observation, Pair], None]:
    if as_json:
        return lambda observation, pair: print(json.dumps(_as_data(observation, pair)), flush=True)
    if classic:
        return _print_classic
    return lambda observation, pair: report_console().print(_tables(observation, pair))


def _report(
    observer: LiveObserver, pair: Pair, seconds: float, printer: Callable[[Observation, Pair], None], *, once: bool
) -> None:
    """Print a report after each time window, or only one."""
    while True:
        observer.listen(seconds)
        observation = observer.observe()
        if once and not len(observation.transforms):
            fail("no transforms received", "Check that a broadcaster is running in the same ROS domain.")
        printer(observation, pair)
        if once:
            return


def _watch(observer: LiveObserver, pair: Pair) -> NoReturn:
    console = report_console()
    with Live(console=console, auto_refresh=False) as live:
        while True:
            most = max(console.height - _RESERVED_LINES, _MIN_ROWS) if console.is_terminal else None
            live.update(_tables(observer.observe(), pair, most), refresh=True)
            observer.listen(1.0)


def _tables(observation: Observation, pair: Pair, limit: int | None = None) -> Group:
    """Return the tables of the edges, with at most `limit` rows, and of the publishers."""
    if not observation.edges:
        return Group(Text("no transforms received yet: is a broadcaster running in the same ROS domain?"))
    edges = _table("edge", "publisher", "Hz", "jitter ms", "delay ms", "p99 ms", "age ms", "count")
    rows = edge_statistics(observation, limit)
    for row in rows:
        figures = (row.jitter, row.delay, row.delay_p99, row.age)
        rate = "static" if row.static else "stale" if row.stale else _format_hertz(row.rate)
        cells = (
            f"{display_name(row.parent)} -> {display_name(row.child)}",
            display_name(row.publisher) or "unknown",
            rate,
            *map(_format_ms, figures),
        )
        edges.add_row(*_cells(*cells, str(row.transforms)), style="red" if row.stale else "")
    publishers = _table("publisher", "messages/s", "delay ms", "p99 ms")
    for node in publisher_statistics(observation):
        delays = (_format_ms(node.delay), _format_ms(node.delay_p99))
        publishers.add_row(*_cells(display_name(node.publisher) or "unknown", _format_hertz(node.rate), *delays))
    chain = [Text(_chain(chain_statistics(observation, *pair), pair))] if pair else []
    left = len(observation.edges) - len({(row.parent, row.child) for row in rows})
    more = [Text(f"... and {count(left, 'more edge')}; `coframe monitor --once` prints all", style="dim")]
    return Group(*chain, edges, *more[: min(left, 1)], publishers)


def _chain(figures: ChainStatistics | None, pair: tuple[str, str]) -> str:
    if figures is None:
        return f"no transforms connect {display_name(pair[0])} and {display_name(pair[1])} yet"
    chain = f"chain: {' -> '.join(map(display_name, figures.frames))}"
    if figures.limit is None:
        return f"{chain}\nno dynamic edge has been received: all edges are static, or some are still missing"
    return (
        f"{chain}\nnet delay: mean {_format_ms(figures.delay)} ms, p99 {_format_ms(figures.delay_p99)} ms; limited by "
        f"{' -> '.join(map(display_name, figures.limit))} for {figures.limit_share:.0%} of the time"
    )


def _as_data(observation: Observation, pair: Pair) -> dict[str, Any]:
    data: dict[str, Any] = {
        "start_ns": observation.start,
        "end_ns": observation.end,
        "edges": [row._asdict() for row in edge_statistics(observation)],
        "publishers": [row._asdict() for row in publisher_statistics(observation)],
    }
    if pair is not None:
        chain = chain_statistics(observation, *pair)
        data["chain"] = None if chain is None else chain._asdict()
    return data


def _print_classic(observation: Observation, pair: Pair) -> None:
    for line in _classic_lines(observation, pair):
        # tf2_monitor prints only this line on stderr.
        print(line, file=sys.stderr if line == _BROADCASTERS else sys.stdout, flush=True)


def _classic_lines(observation: Observation, pair: Pair) -> Iterator[str]:
    """Yield the lines of tf2_monitor, with the names of publishers instead of ``<no authority available>``.

    The delay of a static transform is printed as 0; tf2_monitor prints the age of the transform.
    """
    yield "\n\n"
    if pair is not None:
        chain = chain_statistics(observation, *pair)
        yield f"RESULTS: for {display_name(pair[0])} to {display_name(pair[1])}"
        if chain is not None:
            yield f"Chain is: {' -> '.join(map(display_name, chain.frames))}"
            yield f"Net delay     avg = {_format_seconds(chain.delay)}: max = {_format_seconds(chain.delay_max)}"
    else:
        yield "RESULTS: for all Frames"
    yield "\nFrames:"
    for row in edge_statistics(observation):
        name = display_name(row.publisher) or "<no authority available>"
        frame = display_name(row.child)
        delays = f"Average Delay: {_format_seconds(row.delay)}, Max Delay: {_format_seconds(row.delay_max)}"
        yield f"Frame: {frame}, published by {name}, {delays}"
    yield _BROADCASTERS
    for node in publisher_statistics(observation):
        name, rate = display_name(node.publisher) or "<no authority available>", node.rate or 0.0
        delays = f"Average Delay: {_format_seconds(node.delay)} Max Delay: {_format_seconds(node.delay_max)}"
        yield f"Node: {name} {rate:g} Hz, {delays}"


def _format_seconds(nanoseconds: float | None) -> str:
    """Format seconds with six significant digits, as C++ streams do."""
    return f"{(nanoseconds or 0.0) / SECOND:g}"


def _format_ms(nanoseconds: float | None) -> str:
    return "" if nanoseconds is None else f"{nanoseconds / MILLISECOND:.1f}"


def _format_hertz(rate: float | None) -> str:
    return "" if rate is None else f"{rate:.1f}"


def _cells(*cells: str) -> list[Text]:
    return [Text(cell, no_wrap=True, overflow="ellipsis") for cell in cells]


def _table(*columns: str) -> Table:
    table = Table(box=None, pad_edge=False, header_style="dim")
    for column in columns:
        # In a narrow terminal, numbers and publishers are truncated first: rich shrinks columns that may wrap, although
        # no cell does.
        is_name = column in {"edge", "publisher"}
        table.add_column(column, justify="left" if is_name else "right", no_wrap=column == "edge")
    return table
