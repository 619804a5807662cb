"""The transform tree of a live buffer as a table: frame, parent, rate, age and pose."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np
from rich.table import Table
from rich.text import Text

from coframe.errors import TransformException
from coframe.time import SECOND

if TYPE_CHECKING:
    from coframe import Buffer, FrameInfo

__all__ = ["tree_table"]

# A dynamic frame without a new transform for this long, in seconds, is shown as stale.
STALE_AFTER = 1.0


def tree_table(buffer: Buffer, reference: str, *, wide: bool = True) -> Table:
    """Return a table with each frame below its parent, and poses in metres and degrees.

    Args:
        buffer: The buffer that contains the frames.
        reference: The frame in which poses are expressed.
        wide: Whether the terminal has at least 100 columns, enough to show millimetres.
    """
    title = f"transform tree, poses relative to {reference} (metres, degrees)"
    table = Table(title=title, title_justify="left", box=None, padding=(0, 1, 0, 0), pad_edge=False)
    for column in ("frame", "parent"):
        table.add_column(column, no_wrap=True)
    decimals = 3 if wide else 2
    position, angles = decimals + 3, decimals + 2  # characters per number
    axes = " ".join(f"{axis:>{position}}" for axis in "xyz")
    turns = " ".join(f"{turn:>{angles}}" for turn in ("roll", "pit", "yaw"))
    for column in ("rate Hz", "age ms", axes, turns):
        table.add_column(column, justify="right", no_wrap=True)
    now = time.time_ns()
    for depth, frame in _in_tree_order(buffer.frames()):
        age = (now - frame.newest) / SECOND
        stale = bool(frame.parent) and not frame.static and age > STALE_AFTER
        table.add_row(
            Text(" " * depth + frame.name, style="dim" if stale else "bold"),
            frame.parent,
            Text(_rate(frame), style="dim" if frame.static else "cyan"),
            Text(_age(frame, age), style="red" if stale else ""),
            *_pose(buffer, reference, frame.name, decimals),
        )
    return table


def _in_tree_order(frames: list[FrameInfo]) -> list[tuple[int, FrameInfo]]:
    """Return each frame with its depth; roots and siblings are sorted by name."""
    children: dict[str, list[FrameInfo]] = {}
    for frame in sorted(frames):
        children.setdefault(frame.parent, []).append(frame)
    ordered: list[tuple[int, FrameInfo]] = []
    waiting = [(0, root) for root in reversed(children.pop("", []))]
    while waiting:
        depth, frame = waiting.pop()
        ordered.append((depth, frame))
        waiting += [(depth + 1, child) for child in reversed(children.pop(frame.name, []))]
    ordered += [(0, frame) for loop in children.values() for frame in loop]
    return ordered


def _rate(frame: FrameInfo) -> str:
    if not frame.parent:
        return "root"
    if frame.static:
        return "static"
    return f"{frame.rate:.1f}" if frame.samples > 1 else "-"


def _age(frame: FrameInfo, age: float) -> str:
    return "" if frame.static or not frame.parent else f"{age * 1e3:.0f}"


def _pose(buffer: Buffer, reference: str, frame: str, decimals: int) -> tuple[str, str]:
    try:
        transform = buffer.lookup(reference, frame)
    except TransformException:
        return "not connected", ""
    position = " ".join(f"{value:{decimals + 3}.{decimals}f}" for value in transform.translation.tolist())
    angles = " ".join(f"{value:{decimals + 2}.{decimals - 2}f}" for value in np.degrees(transform.rpy).tolist())
    return position, angles
