# SPDX-License-Identifier: Apache-2.0
"""Forest: the frames as trees, each with the statistics of the edge to its parent."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.analysis.clock_offset import ClockOffset
    from coframe.doctor.statistics import EdgeStatistics

__all__ = ["Forest", "Frame"]


@dataclass(frozen=True)
class Frame:
    """A frame and its position in the drawing. Times are nanoseconds.

    Attributes:
        name: The name of the frame in tf2.
        parent: The parent frame, or "" for a root.
        root: The root of the tree in which it is drawn.
        depth: The number of edges up to the root.
        children: The frames that are drawn below it, by name.
        edges: The statistics of the edge from its parent, one entry per publisher.
        other_edges: The statistics of the edges from other parents. A tree can contain only one of these edges.
        silence: The time since the last transform of the frame, if its edge is stale; else None.
        offset: How far the stamps of its edge are off, if the doctor reports it (TF008, TF009); else None.
    """

    name: str
    parent: str
    root: str
    depth: int
    children: tuple[str, ...]
    edges: tuple[EdgeStatistics, ...]
    other_edges: tuple[EdgeStatistics, ...]
    silence: int | None
    offset: ClockOffset | None = None

    @property
    def is_root(self) -> bool:
        """Whether a tree is drawn from here: the frame has no parent, or is the first frame of a loop."""
        return self.depth == 0

    @property
    def static(self) -> bool:
        """Whether the edge from its parent is static."""
        return bool(self.edges) and all(edge.static for edge in self.edges)

    @property
    def kind(self) -> str:
        """The kind of drawing: ``root``, ``stale``, ``static`` or ``moving``."""
        if self.is_root:
            return "root"
        if self.silence is not None:
            return "stale"
        return "static" if self.static else "moving"


@dataclass(frozen=True)
class Forest:
    """All trees of an observation.

    Attributes:
        start: The start of the observation, or of the recording; int64 nanoseconds.
        end: The end of the observation, or of the recording; int64 nanoseconds.
        live: Whether it was received from the ROS graph, not read from a recording.
        frames: The frames by name, in drawing order: tree after tree, parents before their children.
        trees: The number of frames of each tree by its root, the largest tree first.
        loops: The roots that are a frame of a loop, where no lookup in tf2 succeeds.
    """

    start: int
    end: int
    live: bool
    frames: dict[str, Frame]
    trees: dict[str, int]
    loops: frozenset[str]

    def by_tree(self) -> Iterator[list[Frame]]:
        """Yield the frames of each tree, the root first."""
        for _, frames in groupby(self.frames.values(), key=lambda frame: frame.root):
            yield list(frames)
