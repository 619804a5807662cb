# SPDX-License-Identifier: Apache-2.0
"""A forest as rows for a terminal: branches and names in the first column, statistics in the others."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe._output.escaping import display_name
from coframe.time import MILLISECOND
from coframe.tree_drawing.labels import stamp_offset_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.statistics import EdgeStatistics
    from coframe.tree_drawing._forest import Forest, Frame

__all__ = ["COLUMNS", "Row", "rows"]

COLUMNS = ("frame", "publisher", "Hz", "jitter ms", "delay ms", "p99 ms", "age ms")
_MAX_INDENTED_LEVELS = 24
"""The maximum indentation; deeper frames have the same one, with their depth as a number."""


class Row(NamedTuple):
    """A row of the table.

    Attributes:
        branches: The branches in front of the name.
        name: The name of the frame; "" in additional rows of the same frame.
        cells: The contents of the other :data:`COLUMNS`.
        frame: The frame of the row.
        kind: As :attr:`Frame.kind`, or ``other`` for an edge from another parent.
    """

    branches: str
    name: str
    cells: tuple[str, ...]
    frame: str
    kind: str


def rows(forest: Forest) -> Iterator[Row]:
    """Yield the rows of tree after tree: one for each frame, and one for each additional publisher of its edge."""
    last: list[bool] = []  # for each level down to the frame, whether it is the last child
    for frame in forest.frames.values():
        del last[max(frame.depth - 1, 0) :]
        if frame.depth:
            siblings = forest.frames[frame.parent].children
            last.append(siblings[-1] == frame.name)
        yield from _rows(frame, last)


def _rows(frame: Frame, last: list[bool]) -> Iterator[Row]:
    to_name, below = _branches(frame, last)
    for number, edge in enumerate(frame.edges or (None,)):
        name = "" if number else display_name(frame.name)
        yield Row(below if number else to_name, name, _cells(edge), frame.name, frame.kind)
    if frame.is_root and frame.parent:
        yield Row(f"{below}in a loop: below ", display_name(frame.parent), ("",) * 6, frame.name, "other")
    if frame.offset is not None:
        yield Row(below, stamp_offset_text(frame.offset), ("",) * 6, frame.name, "other")
    for edge in frame.other_edges:
        yield Row(f"{below}also below ", display_name(edge.parent), _cells(edge), frame.name, "other")


def _branches(frame: Frame, last: list[bool]) -> tuple[str, str]:
    """Return the branches in front of the name of a frame, and in front of its additional rows."""
    stem = "│ " if frame.children else "  "
    if not last:
        return "", stem
    above = last[:-1]
    deep = f"({frame.depth}) " if len(above) > _MAX_INDENTED_LEVELS else ""
    trunks = "".join("   " if end else "│  " for end in above[:_MAX_INDENTED_LEVELS])
    return trunks + deep + ("└─ " if last[-1] else "├─ "), trunks + deep + ("   " if last[-1] else "│  ") + stem


def _cells(edge: EdgeStatistics | None) -> tuple[str, ...]:
    if edge is None:
        return ("", "root", *[""] * 4)
    if edge.static:
        return (display_name(edge.publisher), "static", *[""] * 4)
    times = (edge.jitter, edge.delay, edge.delay_p99, edge.age)
    rate = "" if edge.rate is None else f"{edge.rate:.1f}"
    return (
        display_name(edge.publisher),
        rate,
        *("" if time is None else f"{round(time / MILLISECOND, 1) + 0.0:.1f}" for time in times),
    )
