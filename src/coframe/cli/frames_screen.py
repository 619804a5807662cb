"""The transform trees on a terminal: once, or again and again with what has changed."""

from __future__ import annotations

import json
import time
from typing import TYPE_CHECKING

from rich.console import Console, Group
from rich.live import Live
from rich.table import Table
from rich.text import Text

from coframe.tree_drawing import changes, grow
from coframe.tree_drawing.labels import summary
from coframe.tree_drawing.plain import as_data
from coframe.tree_drawing.text import COLUMNS, rows

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.live import LiveObserver
    from coframe.tree_drawing import Change, Forest

__all__ = ["tree", "watch"]

_KINDS = {"root": "bold", "moving": "cyan", "static": "", "stale": "red", "other": "red"}
_STYLES = {"came": "green", "moved": "yellow", "stale": "red", "fresh": "green", "gone": "red"}
_PUBLISHER = 1  # which of the columns
_HIGHLIGHTED = 5.0  # seconds
_REMEMBERED = 1000  # changes
_NAMED = 8  # of them, below the tree
_STEP = 1.0


def tree(forest: Forest, changed: dict[str, str] | None = None, most: int | None = None) -> Group:
    """All trees, or of more than so many rows the first ones, and what is to be said of the whole.

    Args:
        forest: What to show.
        changed: Frames to highlight, by what happened to them.
        most: Rows; None: all.
    """
    every = list(rows(forest))
    cut = every if most is None or len(every) <= most else every[: most - 1]
    told = [column for column in range(len(COLUMNS) - 1) if any(row.cells[column] for row in every)]
    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0), header_style="dim")
    for number in (0, *(column + 1 for column in told)):
        # On a narrow screen publishers are cut first: rich takes room from columns that may wrap, which no cell does.
        wraps = number == _PUBLISHER
        table.add_column(COLUMNS[number], justify="left" if number <= _PUBLISHER else "right", no_wrap=not wraps)
    for row in cut:
        kind = (changed or {}).get(row.frame)
        style = f"reverse {_STYLES[kind]}" if kind else _KINDS[row.kind]
        name = Text.assemble((row.branches, "dim"), (row.name, style), no_wrap=True, overflow="ellipsis")
        rest = "red" if row.kind == "stale" else ""
        cells = (Text(row.cells[column], style=rest, no_wrap=True, overflow="ellipsis") for column in told)
        table.add_row(name, *cells)
    left = len(every) - len(cut)
    more = [Text(f"... and {left} more rows, which `coframe frames` prints", style="dim")] if left else []
    style = "yellow" if len(forest.trees) > 1 or forest.loops else "green"
    return Group(table, *more, Text(summary(forest), style=style))


def watch(listening: LiveObserver, as_json: bool) -> None:
    """Shows the trees until Ctrl-C; where nobody looks at a screen a line a change, or with JSON a line each second."""
    console = Console(highlight=False)
    if as_json:
        for forest, news in _steps(listening):
            print(json.dumps({**as_data(forest), "changes": [change._asdict() for change in news]}), flush=True)
    elif console.is_terminal:
        _show(console, _steps(listening))
    else:
        _tell(_steps(listening))


def _steps(listening: LiveObserver) -> Iterator[tuple[Forest, list[Change]]]:
    """The forest of each second, and how it differs from the one before."""
    before: Forest | None = None
    while True:
        listening.listen(_STEP)
        forest = grow(listening.observe())
        yield forest, [] if before is None else list(changes(before, forest))
        before = forest


def _show(console: Console, steps: Iterator[tuple[Forest, list[Change]]]) -> None:
    log: list[tuple[float, Text, Change]] = []
    with Live(console=console, auto_refresh=False) as live:
        for forest, news in steps:
            now = time.monotonic()
            log = [*log, *((now, _line(change), change) for change in news)][-_REMEMBERED:]
            changed = {change.frame: change.kind for at, _, change in log if now - at < _HIGHLIGHTED}
            named = [line for _, line, _ in log[-_NAMED:]]
            room = console.height - len(named) - 4  # the table's head, the summary, a cut, and one to spare
            live.update(Group(tree(forest, changed, max(room, 2)), *named), refresh=True)


def _tell(steps: Iterator[tuple[Forest, list[Change]]]) -> None:
    for number, (forest, news) in enumerate(steps):
        if number == 0:
            print(summary(forest), flush=True)
        for change in news:
            print(_line(change), flush=True)


def _line(change: Change) -> Text:
    return Text(f"{time.strftime('%H:%M:%S')} {change.text}", style=_STYLES[change.kind])
