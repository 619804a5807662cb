# SPDX-License-Identifier: Apache-2.0
"""``coframe relay``: merges the transforms of several robots into one topic, or splits them."""

from __future__ import annotations

import contextlib
import threading
import time
from typing import TYPE_CHECKING

import click
from rich.console import Console, Group
from rich.live import Live
from rich.table import Table
from rich.text import Text

from coframe._output.escaping import display_name
from coframe._output.formatting import count
from coframe.cli.declaration import Command
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import TF_TOPIC, checked_prefix, domain_option, keep_option, prefix_option, topic_name
from coframe.cli.output import fail, log, one_line, report_console
from coframe.tf_relay.starting import relay as start_relay

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.tf_relay import Relay, RelayedEdge

__all__ = ["relay"]

NODE = "coframe_relay"
REFRESH = 1.0  # seconds


@click.command(cls=Command)
@click.option(
    "--robots",
    metavar="NAMES",
    default="",
    show_default=False,
    help="Names of the robots, e.g. robot1,robot2 for /robot1/tf and /robot2/tf.",
)
@click.option(
    "--from",
    "sources",
    metavar="TOPIC[=PREFIX]",
    multiple=True,
    help="Topic of one robot, or with --split the common topic; repeatable. Static transforms are read from "
    "TOPIC_static.",
)
@click.option(
    "--to",
    "--tf-topic",
    "tf_topic",
    metavar="TOPIC",
    type=topic_name,
    default=TF_TOPIC,
    help="Common topic: the output or, with --split, the input.",
)
@click.option(
    "--tf-static-topic",
    metavar="TOPIC",
    type=topic_name,
    help="Common topic of the static transforms. [default: the topic of --to with _static appended]",
)
@prefix_option
@click.option("--prefix-each", is_flag=True, help="Prefix the frames of each robot with its name and a slash.")
@keep_option
@click.option(
    "--rate",
    metavar="HZ",
    type=float,
    help="Maximum rate of each edge, in Hz; with --max-error, the minimum rate while a robot moves. "
    "[default: all transforms; with --max-error: 10]",
)
@click.option(
    "--max-error",
    metavar="DISTANCE,ANGLE",
    help="Omit transforms that subscribers can interpolate within this error, e.g. 1mm,0.1deg.",
)
@click.option(
    "--split",
    is_flag=True,
    help="Relay in reverse: frames with the prefix robot1/ go to /robot1/tf, without the prefix.",
)
@click.option("--status", is_flag=True, help="Show each edge with its source, rate and age.")
@domain_option
def relay(
    robots: str,
    sources: tuple[str, ...],
    tf_topic: str,
    tf_static_topic: str | None,
    prefix: str,
    prefix_each: bool,
    keep: str,
    rate: float | None,
    max_error: str | None,
    split: bool,
    status: bool,
    domain: int | None,
) -> None:
    """Relay the transforms of several robots to one topic, or split one topic into one topic per robot.

    Problems are reported as warnings: robots that stop publishing, wrong clocks, frames that two robots publish, and
    frame names with leading slashes or incomplete prefixes.

    Example: coframe relay --robots robot1,robot2 --prefix-each --keep map,world
    """
    prefixes = _prefixes(sources)
    common = tf_topic
    if split:
        common = next(iter(prefixes), tf_topic)
        if len(prefixes) > 1 or any(prefixes.values()):
            fail("--split reads a single --from topic without a prefix", "Use --robots to name the robots.", code=2)
        prefixes = {}
    with run_until_interrupted(), contextlib.ExitStack() as stack:
        try:
            running = start_relay(
                robots,
                sources=prefixes,
                common=common,
                common_static=tf_static_topic,
                prefix=prefix,
                prefix_each=prefix_each,
                keep=keep,
                rate=rate,
                max_error=max_error,
                split=split,
                domain=domain,
                node_name=NODE,
                warn=lambda text: log("WARN", NODE, text),
            )
        except ValueError as error:
            fail(str(error), "coframe relay --help shows an example.", code=2)
        stack.enter_context(running)
        for line in running.routes:
            log("INFO", NODE, line)
        if status:
            _show(running)
        threading.Event().wait()


def _prefixes(sources: Iterable[str]) -> dict[str, str]:
    """Return the prefix of each topic from arguments TOPIC=PREFIX."""
    pairs = [source.partition("=") for source in sources]
    return {topic: checked_prefix(prefix) for topic, _, prefix in pairs}


def _show(active_relay: Relay) -> None:
    """Show the table until Ctrl-C; without a terminal, print it once as soon as there are edges."""
    console = Console()
    rates = _Rates()
    if console.is_terminal:
        with Live(console=console, refresh_per_second=1 / REFRESH) as live:
            while True:
                live.update(_table(active_relay, rates, max(console.height - 3, 1)))
                time.sleep(REFRESH)
    while not active_relay.edges():
        time.sleep(REFRESH)
    time.sleep(REFRESH)
    report_console().print(_table(active_relay, rates))


class _Rates:
    """The rate of each edge between two updates of the table."""

    def __init__(self) -> None:
        self._seen_counts: dict[tuple[str, str, str], int] = {}
        self._at = 0.0

    def update(self, edges: list[RelayedEdge]) -> dict[tuple[str, str, str], float]:
        """Return the rates in Hz by target, parent and child."""
        now = time.monotonic()
        seen = {(edge.target, edge.parent, edge.child): edge.forwarded for edge in edges}
        elapsed = max(now - self._at, 1e-9)
        rates = {
            key: (passed - self._seen_counts.get(key, 0)) / elapsed for key, passed in seen.items() if self._seen_counts
        }
        self._seen_counts, self._at = seen, now
        return rates


def _table(active_relay: Relay, rates: _Rates, limit: int | None = None) -> Group:
    """Return a table of the edges with at most `limit` rows."""
    table = Table(box=None, pad_edge=False, header_style="dim")
    for column in ("edge", "robot", "from", "node", "to", "Hz", "age s", ""):
        table.add_column(column, justify="right" if column in {"Hz", "age s"} else "left")
    robots = active_relay.robots
    states = {robot.name: robot.state for robot in robots}
    edges = sorted(active_relay.edges(), key=lambda edge: (edge.target, edge.robot, edge.parent, edge.child))
    each = rates.update(edges)
    for edge in edges[:limit]:
        note = f"also published by {edge.conflicting_robot}, which is ignored" if edge.conflicting_robot else ""
        if states[edge.robot] in {"gone", "stale"}:
            has_left = states[edge.robot] == "gone"
            note = f"stale: {edge.robot} {'left the ROS graph' if has_left else 'stopped publishing'}"
        hertz = each.get((edge.target, edge.parent, edge.child))
        cells = [
            f"{display_name(edge.parent)} -> {display_name(edge.child)}",
            *map(display_name, (edge.robot, edge.source, edge.node, edge.target)),
            "static" if edge.static else "-" if hertz is None else f"{hertz:.1f}",
            "" if edge.static else f"{edge.age:.1f}",
            note,
        ]
        table.add_row(*(Text(one_line(cell), style="red" if note else "") for cell in cells))
    left = len(edges) - len(table.rows)
    notes = [f"... and {count(left, 'more edge')}"] if left else []
    notes += [f"not relayed of {one.name}: {one.not_relayed}" for one in robots if any(one.not_relayed)]
    return Group(table, *(Text(one_line(note), style="dim") for note in notes))
