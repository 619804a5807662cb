# SPDX-License-Identifier: Apache-2.0
"""The transform trees in a terminal, printed once or updated with changes highlighted."""

from __future__ import annotations

import json
import time
from typing import TYPE_CHECKING

from rich.cells import cell_len
from rich.console import Console, Group
from rich.live import Live
from rich.table import Table
from rich.text import Text

from coframe._output.formatting import count
from coframe.cli.output import print_bounded, report_console
from coframe.tree_drawing import build_forest, changes
from coframe.tree_drawing.labels import summary
from coframe.tree_drawing.plain import as_data
from coframe.tree_drawing.text import COLUMNS, rows

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.live import LiveObserver
    from coframe.tree_drawing import Change, Forest
    from coframe.tree_drawing.text import Row

__all__ = ["tree", "tree_tables", "watch"]

_KIND_STYLES = {"root": "bold", "moving": "cyan", "static": "", "stale": "red", "other": "red"}
_CHANGE_STYLES = {"new": "green", "moved": "yellow", "stale": "red", "resumed": "green", "gone": "red"}
_PUBLISHER_COLUMN = 1  # index of the column
_MIN_PUBLISHER = 12  # columns of the terminal, below which the last numbers are omitted
_HIGHLIGHT_TIME = 5.0  # seconds
_MAX_CHANGES = 1000  # kept for highlighting
_LISTED_CHANGES = 8  # below the tree
_PERIOD = 1.0  # seconds
_MAX_TABLE_ROWS = 2000  # rows per table


def tree(forest: Forest, changes: dict[str, str] | None = None, limit: int | None = None) -> Group:
    """Return a table of the trees, followed by a summary.

    Args:
        forest: The trees to show.
        changes: The kind of change of each frame to highlight.
        limit: Maximum number of rows, or None for no limit.
    """
    every = list(rows(forest))
    cut = every if limit is None or len(every) <= limit else every[: limit - 1]
    left = len(every) - len(cut)
    more = [Text(f"... and {count(left, 'more row')}; `coframe frames` prints all", style="dim")] if left else []
    return Group(_table(cut, _columns(every), changes or {}), *more, _summary(forest))


def tree_tables(forest: Forest) -> Iterator[Table | Text]:
    """Yield the trees in tables of limited size, because rich needs 10 kB of memory per row."""
    every = list(rows(forest))
    columns = _columns(every)
    for first in range(0, len(every), _MAX_TABLE_ROWS):
        table = _table(every[first : first + _MAX_TABLE_ROWS], columns, {})
        if len(every) > _MAX_TABLE_ROWS:
            table.show_header = first == 0
            for column, width in zip(table.columns, columns.values(), strict=True):
                column.min_width = width
        yield table
    yield _summary(forest)


def _columns(rows: list[Row]) -> dict[int, int]:
    """Return the columns that are used, and the width of each. The first one is the frame."""
    cells = {
        number: [
            COLUMNS[number],
            *((row.branches + row.name if number == 0 else row.cells[number - 1]) for row in rows),
        ]
        for number in range(len(COLUMNS))
    }
    used = {number: max(map(cell_len, texts)) for number, texts in cells.items() if number == 0 or any(texts[1:])}
    return _fitting(used, report_console().width)


def _fitting(columns: dict[int, int], width: int) -> dict[int, int]:
    """Return the columns that fit a terminal with complete names: the last numbers are omitted first."""
    kept = dict(columns)
    needed = {
        number: min(size, _MIN_PUBLISHER) if number == _PUBLISHER_COLUMN else size for number, size in kept.items()
    }
    for number in sorted(columns, reverse=True)[:-1]:
        if sum(needed[each] + 1 for each in kept) - 1 <= width:
            break
        del kept[number]
    return kept


def _table(rows: list[Row], columns: dict[int, int], changes: dict[str, str]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0), header_style="dim")
    for number in columns:
        # In a narrow terminal, publishers are truncated first: rich shrinks columns that may wrap, although no cell
        # does.
        wraps = number == _PUBLISHER_COLUMN
        table.add_column(COLUMNS[number], justify="left" if number <= _PUBLISHER_COLUMN else "right", no_wrap=not wraps)
    for row in rows:
        kind = changes.get(row.frame)
        style = f"reverse {_CHANGE_STYLES[kind]}" if kind else _KIND_STYLES[row.kind]
        name = Text.assemble((row.branches, "dim"), (row.name, style), no_wrap=True, overflow="ellipsis")
        rest = "red" if row.kind == "stale" else ""
        cells = (
            Text(row.cells[number - 1], style=rest, no_wrap=True, overflow="ellipsis") for number in columns if number
        )
        table.add_row(name, *cells)
    return table


def _summary(forest: Forest) -> Text:
    return Text(summary(forest), style="yellow" if len(forest.trees) > 1 or forest.loops else "green")


def watch(observer: LiveObserver, as_json: bool) -> None:
    """Show the trees until Ctrl-C; without a terminal, print a line for each change, or a line of JSON every second."""
    console = Console(highlight=False)
    if as_json:
        for forest, news in _steps(observer):
            print(json.dumps({**as_data(forest), "changes": [change._asdict() for change in news]}), flush=True)
    elif console.is_terminal:
        _show(console, _steps(observer))
    else:
        _print_changes(_steps(observer))


def _steps(observer: LiveObserver) -> Iterator[tuple[Forest, list[Change]]]:
    """Yield the trees every second, with the changes since the previous second."""
    before: Forest | None = None
    while True:
        observer.listen(_PERIOD)
        forest = build_forest(observer.observe())
        yield forest, [] if before is None else list(changes(before, forest))
        before = forest


def _show(console: Console, steps: Iterator[tuple[Forest, list[Change]]]) -> None:
    log: list[tuple[float, Text, Change]] = []
    with Live(console=console, auto_refresh=False) as live:
        for forest, news in steps:
            now = time.monotonic()
            log = [*log, *((now, _line(change), change) for change in news)][-_MAX_CHANGES:]
            changed = {change.frame: change.kind for at, _, change in log if now - at < _HIGHLIGHT_TIME}
            change_lines = [line for _, line, _ in log[-_LISTED_CHANGES:]]
            # Four more lines: the header, the summary, the line about more rows, and an empty one.
            room = console.height - len(change_lines) - 4
            live.update(Group(tree(forest, changed, max(room, 2)), *change_lines), refresh=True)


def _print_changes(steps: Iterator[tuple[Forest, list[Change]]]) -> None:
    for number, (forest, news) in enumerate(steps):
        if number == 0:
            print(summary(forest), flush=True)
        for change in news:
            print_bounded(_line(change).plain)


def _line(change: Change) -> Text:
    return Text(f"{time.strftime('%H:%M:%S')} {change.text}", style=_CHANGE_STYLES[change.kind])
