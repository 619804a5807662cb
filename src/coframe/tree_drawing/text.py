"""A forest as rows for a terminal: branches and names in the first column, figures in the others."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe.tree_drawing.labels import shown

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.figures import EdgeFigures
    from coframe.tree_drawing.forest import Forest, Frame

__all__ = ["COLUMNS", "Row", "rows"]

COLUMNS = ("frame", "publisher", "Hz", "jitter ms", "delay ms", "p99 ms", "age ms")
_MS = 1e6
_DEEPEST = 24
"""Levels: what is below is drawn there, too, with its depth as a number."""


class Row(NamedTuple):
    """A line of the picture.

    Attributes:
        branches: What leads to the name from its parent's row.
        name: Of a frame; "" in further rows of the same one.
        cells: What stands below the other :data:`COLUMNS`.
        frame: Which frame it is about.
        kind: As :attr:`Frame.kind`, or ``other``: it is told to be below another parent, too.
    """

    branches: str
    name: str
    cells: tuple[str, ...]
    frame: str
    kind: str


def rows(forest: Forest) -> Iterator[Row]:
    """Tree after tree, a row for each frame and for each further publisher of it."""
    last: list[bool] = []  # of each level down to the frame: whether it is the last child
    for frame in forest.frames.values():
        del last[max(frame.depth - 1, 0) :]
        if frame.depth:
            siblings = forest.frames[frame.parent].children
            last.append(siblings[-1] == frame.name)
        yield from _rows(frame, last)


def _rows(frame: Frame, last: list[bool]) -> Iterator[Row]:
    to_name, below = _branches(frame, last)
    for number, link in enumerate(frame.edges or (None,)):
        name = "" if number else shown(frame.name)
        yield Row(below if number else to_name, name, _cells(link), frame.name, frame.kind)
    if frame.is_root and frame.parent:
        yield Row(f"{below}in a loop: below ", shown(frame.parent), ("",) * 6, frame.name, "other")
    for link in frame.other_edges:
        yield Row(f"{below}also below ", shown(link.parent), _cells(link), frame.name, "other")


def _branches(frame: Frame, last: list[bool]) -> tuple[str, str]:
    """What stands in front of a frame's name, and in front of its further rows."""
    stem = "│ " if frame.children else "  "
    if not last:
        return "", stem
    above = last[:-1]
    deep = f"({frame.depth}) " if len(above) > _DEEPEST else ""
    trunks = "".join("   " if end else "│  " for end in above[:_DEEPEST])
    return trunks + deep + ("└─ " if last[-1] else "├─ "), trunks + deep + ("   " if last[-1] else "│  ") + stem


def _cells(link: EdgeFigures | None) -> tuple[str, ...]:
    if link is None:
        return ("", "root", *[""] * 4)
    if link.static:
        return (shown(link.publisher), "static", *[""] * 4)
    times = (link.jitter, link.delay, link.delay_p99, link.age)
    rate = "" if link.rate is None else f"{link.rate:.1f}"
    return (
        shown(link.publisher),
        rate,
        *("" if time is None else f"{round(time / _MS, 1) + 0.0:.1f}" for time in times),
    )
