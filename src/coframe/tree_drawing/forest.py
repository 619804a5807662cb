"""Forest: the frames as trees, each with the figures of the links that lead to it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.figures import EdgeFigures

__all__ = ["Forest", "Frame"]


@dataclass(frozen=True)
class Frame:
    """A frame where it is drawn. Times are nanoseconds.

    Attributes:
        name: As tf2 knows it.
        parent: The frame that it is told in; "" for a root.
        root: Of the tree that it is drawn in.
        depth: Links up to the root.
        children: The frames drawn below it, by name.
        links: What is told of the link from its parent, one a publisher.
        others: What is told of links from other parents: only one of them can hold.
        silence: How long nothing was heard of it, if it moves and that is too long; None otherwise.
    """

    name: str
    parent: str
    root: str
    depth: int
    children: tuple[str, ...]
    links: tuple[EdgeFigures, ...]
    others: tuple[EdgeFigures, ...]
    silence: int | None

    @property
    def is_root(self) -> bool:
        """Whether a tree is drawn from here: nothing is above, or only what is below, too."""
        return self.depth == 0

    @property
    def static(self) -> bool:
        """Whether its place below its parent never changes."""
        return bool(self.links) and all(link.static for link in self.links)

    @property
    def kind(self) -> str:
        """What it is drawn as: ``root``, ``stale`` (it moves, and is no longer told of), ``static`` or ``moving``."""
        if self.is_root:
            return "root"
        if self.silence is not None:
            return "stale"
        return "static" if self.static else "moving"


@dataclass(frozen=True)
class Forest:
    """All trees.

    Attributes:
        start: When listening, or the recording, began; int64 nanoseconds.
        end: When it ended.
        live: Heard on the wire rather than read from a recording.
        frames: By name, in the order of drawing: tree after tree, each frame in front of what is below it.
        trees: How many frames each tree has, by root, the largest tree first.
        loops: The roots that are a frame of a loop: tf2 can look up nothing there.
    """

    start: int
    end: int
    live: bool
    frames: dict[str, Frame]
    trees: dict[str, int]
    loops: frozenset[str]

    def by_tree(self) -> Iterator[list[Frame]]:
        """The frames of one tree after the other, its root first."""
        for _, frames in groupby(self.frames.values(), key=lambda frame: frame.root):
            yield list(frames)
