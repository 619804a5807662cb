"""The link that most likely is missing between two trees, by the names of their frames."""

from __future__ import annotations

import difflib
import re
import shlex
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = ["MissingEdge", "missing_edge", "tree_of", "unknown_mount"]

_ALIKE = 0.8
_COMPARED = 1_000  # names: each takes microseconds
# Parents and children by REP-105 and by habit.
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
    """A link that would make one tree of two.

    Attributes:
        parent: A frame of one tree.
        child: The root of the other one.
        misspelt: Whether the two are meant to be one frame, and one name is misspelt.
    """

    parent: str
    child: str
    misspelt: bool

    @property
    def text(self) -> str:
        """What is likely, in a few words."""
        if self.misspelt:
            return f"{self.child!r} looks like {self.parent!r} misspelt"
        return f"most likely {self.parent} -> {self.child} is missing"

    @property
    def fix(self) -> str:
        """What to do, as a finding says it: the line to change, or the command to run."""
        if self.misspelt:
            return self.hint
        names = f"--frame-id {shlex.quote(self.parent)} --child-frame-id {shlex.quote(self.child)}"
        command = f"coframe static {names} --x ... --yaw ..."
        return f"If {self.parent} -> {self.child} never moves: `{command}`; else start the node that publishes it."

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
    """What to do about a tree whose root nobody tells of, where no link is more likely than others."""
    return (
        f"Publish a transform with child_frame_id = {root!r}; if it never moves: "
        f"coframe static --frame-id PARENT --child-frame-id {shlex.quote(root)} --x ... --yaw ..."
    )


def tree_of(root: str, parents: Mapping[str, str]) -> list[str]:
    """The frames of a tree, its root in front, from the parents of all frames; "" for those that have none.

    Example:
        >>> tree_of("odom", {"lidar": "base", "base": "odom", "odom": "", "map": ""})
        ['odom', 'base', 'lidar']
    """
    below: dict[str, list[str]] = {}
    for frame, parent in parents.items():
        below.setdefault(parent, []).append(frame)
    found = {root}
    pending = [root]
    while pending:
        new = set(below.get(pending.pop(), ())) - found
        found |= new
        pending += new
    return [root, *sorted(found - {root})]


def missing_edge(first: Sequence[str], second: Sequence[str]) -> MissingEdge | None:
    """The most likely link between two trees: a misspelt name, or what is usual; None if none is likely.

    Args:
        first: The frames of the larger tree, its root in front.
        second: Those of the other one, likewise.

    Example:
        >>> missing_edge(["odom", "base_link"], ["base_lnk", "lidar"])
        MissingEdge(parent='base_link', child='base_lnk', misspelt=True)
        >>> missing_edge(["odom", "base_footprint"], ["base_link", "wheel"])
        MissingEdge(parent='base_footprint', child='base_link', misspelt=False)
    """
    sides = ((second[0], first), (first[0], second))
    for root, frames in sides:
        alike = [
            frame
            for frame in difflib.get_close_matches(root, frames[:_COMPARED], n=3, cutoff=_ALIKE)
            if _is_slip(root, frame)
        ]
        if alike:
            return MissingEdge(alike[0], root, misspelt=True)
    for parent, child in _USUAL:
        for root, frames in sides:
            if _bare(root) != child:
                continue
            above = [frame for frame in frames if _bare(frame) == parent and _prefix(frame) == _prefix(root)]
            if above:
                return MissingEdge(above[0], root, misspelt=False)
    return None


def _is_slip(name: str, other: str) -> bool:
    """Whether one may be meant for the other: wheel_left and wheel_right, link1 and link2 are two names."""
    return re.findall(r"\d+", name) == re.findall(r"\d+", other) and not (
        {"left", "right", "front", "rear", "back", "upper", "lower"} & (_words(name) ^ _words(other))
    )


def _words(name: str) -> set[str]:
    return set(re.split(r"[^a-z]+", name.lower()))


def _bare(frame: str) -> str:
    return frame.rpartition("/")[2]


def _prefix(frame: str) -> str:
    return frame.rpartition("/")[0]
