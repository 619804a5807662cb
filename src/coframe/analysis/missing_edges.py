"""The edge that is most likely missing between two trees, by the names of their frames."""

from __future__ import annotations

import difflib
import re
from typing import TYPE_CHECKING, NamedTuple

from coframe.analysis.static_command import static_command

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["MissingEdge", "missing_edge", "unknown_mount"]

_SIMILARITY = 0.8
_MOST_COMPARED = 1_000  # names: comparing one takes microseconds
# Usual pairs of parent and child, from REP-105 and common robots.
_USUAL = (
    ("base_footprint", "base_link"),
    ("odom", "base_footprint"),
    ("odom", "base_link"),
    ("map", "odom"),
    ("map", "base_link"),
    ("earth", "map"),
    ("world", "map"),
    ("world", "odom"),
    ("world", "base_link"),
)


class MissingEdge(NamedTuple):
    """An edge that would connect two trees.

    Attributes:
        parent: A frame of one tree.
        child: The root of the other tree.
        misspelt: Whether the two names are probably meant to be one frame, one of them misspelt.
    """

    parent: str
    child: str
    misspelt: bool

    @property
    def text(self) -> str:
        """The probable cause, as a clause."""
        if self.misspelt:
            return f"{self.child!r} looks like a misspelling of {self.parent!r}"
        return f"the transform {self.parent} -> {self.child} is probably missing"

    @property
    def fix(self) -> str:
        """What to do, for findings: the line of code to change, or the command to run."""
        if self.misspelt:
            return self.hint
        edge, command = f"{self.parent} -> {self.child}", static_command(self.parent, self.child)
        return f"If {edge} never moves, run `{command}`; otherwise start the node that publishes it."

    @property
    def hint(self) -> str:
        """What to do, as an exception says it: in terms of the Python API."""
        if self.misspelt:
            return (
                f"In the node that publishes {self.child!r}, change the line to t.header.frame_id = {self.parent!r} "
                f"(or t.child_frame_id); the two names must be the same."
            )
        return (
            f"If {self.parent} -> {self.child} never moves, publish it with a StaticTransformBroadcaster or insert it "
            f"with buffer.set({self.parent!r}, {self.child!r}, ..., static=True); otherwise start the node that "
            "publishes it."
        )


def unknown_mount(root: str) -> str:
    """Return what to do about a tree with this root where no missing edge is more likely than others."""
    return (
        f"Publish a transform with child_frame_id = {root!r}; if it never moves, run "
        f"`{static_command('PARENT', root)}`."
    )


def missing_edge(first: Sequence[str], second: Sequence[str]) -> MissingEdge | None:
    """Return the edge that is most likely missing between two trees, or None if none is likely.

    Misspelt names are tried first, then the usual pairs of frames.

    Args:
        first: The frames of the larger tree, its root first.
        second: The frames of the smaller tree, its root first.

    Example:
        >>> missing_edge(["odom", "base_link"], ["base_lnk", "lidar"])
        MissingEdge(parent='base_link', child='base_lnk', misspelt=True)
        >>> missing_edge(["odom", "base_footprint"], ["base_link", "wheel"])
        MissingEdge(parent='base_footprint', child='base_link', misspelt=False)
    """
    sides = ((second[0], first), (first[0], second))
    for root, frames in sides:
        similar = [
            frame
            for frame in difflib.get_close_matches(root, frames[:_MOST_COMPARED], n=3, cutoff=_SIMILARITY)
            if _is_misspelling(root, frame)
        ]
        if similar:
            return MissingEdge(similar[0], root, misspelt=True)
    for parent, child in _USUAL:
        for root, frames in sides:
            if _without_prefix(root) != child:
                continue
            above = [frame for frame in frames if _without_prefix(frame) == parent and _prefix(frame) == _prefix(root)]
            if above:
                return MissingEdge(above[0], root, misspelt=False)
    return None


def _is_misspelling(name: str, other: str) -> bool:
    """Return whether one name may be meant for the other; not for pairs such as wheel_left and wheel_right."""
    return re.findall(r"\d+", name) == re.findall(r"\d+", other) and not (
        {"left", "right", "front", "rear", "back", "upper", "lower"} & (_words(name) ^ _words(other))
    )


def _words(name: str) -> set[str]:
    return set(re.split(r"[^a-z]+", name.lower()))


def _without_prefix(frame: str) -> str:
    return frame.rpartition("/")[2]


def _prefix(frame: str) -> str:
    return frame.rpartition("/")[0]
