# SPDX-License-Identifier: Apache-2.0
"""Format names and statistics of frames as short lines of text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.escaping import display_name
from coframe._output.formatting import count, duration, join_names

if TYPE_CHECKING:
    from coframe.analysis.clock_offset import ClockOffset
    from coframe.doctor.statistics import EdgeStatistics
    from coframe.tree_drawing._forest import Forest, Frame

__all__ = ["edge_statistics", "figures", "position_problems", "stamp_offset_text", "summary"]

_MAX_LISTED_EDGES = 5


def figures(frame: Frame) -> list[str]:
    """Return the statistics of the edge to a frame's parent by publisher, for at most a few publishers."""
    found = [line for edge in frame.edges[:_MAX_LISTED_EDGES] for line in edge_statistics(edge)]
    more = len(frame.edges) - _MAX_LISTED_EDGES
    return [*found, f"and {count(more, 'more publisher')}"] if more > 0 else found


def position_problems(frame: Frame) -> list[str]:
    """Return problems with the position of a frame: it is in a loop, is stale, or also has other parents."""
    found = [f"in a loop: below {display_name(frame.parent)}"] if frame.is_root and frame.parent else []
    if frame.silence is not None:
        found.append(f"stale: no transform for {duration(frame.silence)}")
    if frame.offset is not None:
        found.append(stamp_offset_text(frame.offset))
    found += [
        f"also below {display_name(edge.parent)}{_publisher_suffix(edge)}"
        for edge in frame.other_edges[:_MAX_LISTED_EDGES]
    ]
    more = len(frame.other_edges) - _MAX_LISTED_EDGES
    return [*found, f"and {more} more"] if more > 0 else found


def stamp_offset_text(offset: ClockOffset) -> str:
    """Return the offset of stamps from the clock of the others as text."""
    return f"stamps {offset.size} {offset.direction} the clock"


def edge_statistics(edge: EdgeStatistics) -> list[str]:
    """Return the statistics of one publisher of an edge. A static edge has none."""
    if edge.static:
        return [f"static{_publisher_suffix(edge)}"]
    rate = ["published once" if edge.rate is None else f"{edge.rate:.1f} Hz"]
    if edge.jitter is not None:
        rate.append(f"jitter {duration(edge.jitter)}")
    ages = [
        f"{name} {duration(value)}"
        for name, value in (("delay", edge.delay), ("p99", edge.delay_p99), ("age", edge.age))
        if value is not None
    ]
    return [line for line in (display_name(edge.publisher), ", ".join(rate), ", ".join(ages)) if line]


def _publisher_suffix(edge: EdgeStatistics) -> str:
    """Return the publisher if it is known: recordings of ROS 2 do not contain it."""
    return f", by {display_name(edge.publisher)}" if edge.publisher else ""


def summary(forest: Forest) -> str:
    """Return the numbers of frames and trees, the roots of several trees, and the loops."""
    period = duration(forest.end - forest.start)
    if not forest.frames:
        return f"no transforms yet, {period}"
    frames = count(len(forest.frames), "frame")
    loops = f"; in a loop: {join_names(map(display_name, sorted(forest.loops)))}" if forest.loops else ""
    if len(forest.trees) == 1:
        return f"{frames} in 1 tree, {period}{loops}"
    roots = join_names(f"{display_name(root)} ({size})" for root, size in forest.trees.items())
    return f"{frames} in {len(forest.trees)} separate trees: {roots}; {period}{loops}"
