"""``coframe relay``: the trees of many robots into one, or one into many."""

from __future__ import annotations

import contextlib
import threading
import time
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.live import Live
from rich.table import Table
from rich.text import Text

import coframe
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import TF_TOPIC, DomainOption, KeepOption, PrefixOption, checked_prefix, with_leading_slash
from coframe.cli.output import fail, log, printable

if TYPE_CHECKING:
    from coframe.tf_relay import Relay, RelayedEdge

__all__ = ["relay"]

NODE = "coframe_relay"
REFRESH = 1.0  # seconds


def relay(
    robots: Annotated[str, typer.Option(help="Their names, such as robot1,robot2: on /robot1/tf, /robot2/tf.")] = "",
    sources: Annotated[
        list[str] | None,
        typer.Option(
            "--from",
            metavar="TOPIC[=PREFIX]",
            help="A robot's topic, or with --split the one where all are; the static ones are on TOPIC_static.",
        ),
    ] = None,
    tf_topic: Annotated[
        str,
        typer.Option(
            "--to", "--tf-topic", help="Where all are written, or read with --split.", callback=with_leading_slash
        ),
    ] = TF_TOPIC,
    tf_static_topic: Annotated[
        str | None,
        typer.Option(
            help="The static ones likewise.", callback=with_leading_slash, show_default="as --to, with _static"
        ),
    ] = None,
    prefix: PrefixOption = "",
    prefix_each: Annotated[
        bool, typer.Option("--prefix-each", help="Put each robot's name and a slash in front of its frames.")
    ] = False,
    keep: KeepOption = "",
    rate: Annotated[
        float | None, typer.Option(help="So many transforms of each edge a second at most.", show_default="all")
    ] = None,
    split: Annotated[
        bool, typer.Option("--split", help="The way back: what begins with robot1/ to /robot1/tf, without that.")
    ] = False,
    status: Annotated[bool, typer.Option("--status", help="Show every edge and where it comes from.")] = False,
    domain: DomainOption = None,
) -> None:
    """Read the transforms of many robots and write them to one topic, or split them up again.

    What is wrong is told as it comes up: a robot that has gone, a clock that is off, a frame that two robots tell of,
    slashes in front of names, half a prefix.

    Example: coframe relay --robots robot1,robot2 --prefix-each --keep map,world
    """
    prefixes = _prefixes(sources or [])
    common = tf_topic
    if split:
        common = next(iter(prefixes), tf_topic)
        if len(prefixes) > 1 or any(prefixes.values()):
            fail("--split reads one topic, and names the robots by --robots", code=2)
        prefixes = {}
    with run_until_interrupted(), contextlib.ExitStack() as stack:
        try:
            running = coframe.relay(
                robots,
                sources=prefixes,
                common=common,
                common_static=tf_static_topic,
                prefix=prefix,
                prefix_each=prefix_each,
                keep=keep,
                rate=rate,
                split=split,
                domain=domain,
                node_name=NODE,
                warn=lambda text: log("WARN", NODE, printable(text)),
            )
        except ValueError as error:
            fail(str(error), "See `coframe relay --help` for an example.", code=2)
        stack.enter_context(running)
        for line in running.routes:
            log("INFO", NODE, printable(line))
        if status:
            _show(running)
        threading.Event().wait()


def _prefixes(sources: list[str]) -> dict[str, str]:
    """By topic."""
    pairs = [source.partition("=") for source in sources]
    return {topic: checked_prefix(prefix) for topic, _, prefix in pairs}


def _show(running: Relay) -> None:
    """Until Ctrl-C; where nobody looks at it, a table when there is something and then no more."""
    console = Console()
    rates = _Rates()
    if console.is_terminal:
        with Live(console=console, refresh_per_second=1 / REFRESH) as live:
            while True:
                live.update(_table(running, rates))
                time.sleep(REFRESH)
    while not running.edges():
        time.sleep(REFRESH)
    time.sleep(REFRESH)
    Console(width=200).print(_table(running, rates))


class _Rates:
    """How many transforms of each edge pass a second, from one look to the next."""

    def __init__(self) -> None:
        self._seen: dict[tuple[str, str, str], int] = {}
        self._at = 0.0

    def take(self, edges: list[RelayedEdge]) -> dict[tuple[str, str, str], float]:
        """By target, parent and child."""
        now = time.monotonic()
        seen = {(edge.target, edge.parent, edge.child): edge.passed for edge in edges}
        elapsed = max(now - self._at, 1e-9)
        rates = {key: (passed - self._seen.get(key, 0)) / elapsed for key, passed in seen.items() if self._seen}
        self._seen, self._at = seen, now
        return rates


def _table(running: Relay, rates: _Rates) -> Table:
    table = Table(box=None, pad_edge=False, header_style="dim")
    for column in ("edge", "robot", "from", "node", "to", "Hz", "age s", ""):
        table.add_column(column, justify="right" if column in {"Hz", "age s"} else "left")
    states = {robot.name: robot.state for robot in running.robots}
    edges = sorted(running.edges(), key=lambda edge: (edge.target, edge.robot, edge.parent, edge.child))
    each = rates.take(edges)
    for edge in edges:
        note = f"also told of by {edge.rival}, which is left out" if edge.rival else ""
        if states[edge.robot] in {"gone", "silent"}:
            note = f"stale: {edge.robot} {'has gone' if states[edge.robot] == 'gone' else 'is silent'}"
        hertz = each.get((edge.target, edge.parent, edge.child))
        cells = [
            f"{edge.parent} -> {edge.child}",
            edge.robot,
            edge.source,
            edge.node,
            edge.target,
            "static" if edge.static else "-" if hertz is None else f"{hertz:.1f}",
            "" if edge.static else f"{edge.age:.1f}",
            note,
        ]
        table.add_row(*(Text(printable(cell), style="red" if note else "") for cell in cells))
    return table
