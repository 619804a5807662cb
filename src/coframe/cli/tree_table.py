# SPDX-License-Identifier: Apache-2.0
"""The transform tree of a live buffer as a table: frame, parent, rate, age and pose."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Group
from rich.table import Table
from rich.text import Text

from coframe._output.escaping import display_name
from coframe._output.formatting import count
from coframe.analysis.tree import FrameTrees
from coframe.errors import TransformException
from coframe.time import SECOND

if TYPE_CHECKING:
    from coframe.analysis.liveness import LivenessTracker
    from coframe.buffer.buffer import Buffer
    from coframe.buffer.edge_info import FrameInfo

__all__ = ["tree_table"]


def tree_table(buffer: Buffer, reference: str, liveness: LivenessTracker, *, limit: int, wide: bool = True) -> Group:
    """Return a table with each frame below its parent, and poses in meters and degrees.

    Args:
        buffer: The buffer that contains the frames.
        reference: The frame in which poses are expressed.
        liveness: Determines which frames are stale; updated by the table.
        limit: Maximum number of rows.
        wide: Whether the terminal has at least 100 columns, enough to show millimeters.
    """
    title = Text(f"transform tree, poses relative to {display_name(reference)} (meters, degrees)")
    table = Table(title=title, title_justify="left", box=None, padding=(0, 1, 0, 0), pad_edge=False)
    for column in ("frame", "parent"):
        table.add_column(column, no_wrap=True)
    decimals = 3 if wide else 2
    position, angles = decimals + 3, decimals + 2  # characters per number
    axes = " ".join(f"{axis:>{position}}" for axis in "xyz")
    turns = " ".join(f"{angle_name:>{angles}}" for angle_name in ("roll", "pit", "yaw"))
    for column in ("rate Hz", "age ms", axes, turns):
        table.add_column(column, justify="right", no_wrap=True)
    now = time.time_ns()
    frames = buffer.frames()
    liveness.update(frames)
    rows = dict(zip((frame.name for frame in frames), zip(frames, liveness.stale().tolist(), strict=True), strict=True))
    trees = FrameTrees.from_parents({frame.name: frame.parent for frame in frames}, sorted(rows))
    for number in trees.order[:limit]:
        frame, stale = rows[trees.names[number]]
        age = (now - frame.newest) / SECOND
        table.add_row(
            Text(" " * trees.depths[number] + display_name(frame.name), style="dim" if stale else "bold"),
            Text(display_name(frame.parent)),
            Text(_rate(frame), style="dim" if frame.static else "cyan"),
            Text(_age(frame, age), style="red" if stale else ""),
            *_pose(buffer, reference, frame.name, decimals),
        )
    left = len(trees.order) - limit
    more = [Text(f"... and {count(left, 'more frame')}", style="dim")] if left > 0 else []
    return Group(table, *more)


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
