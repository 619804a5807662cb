"""TF001: frames that no chain of transforms connects, and the link that is most likely missing."""

from __future__ import annotations

import difflib
import re
from typing import TYPE_CHECKING, NamedTuple

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.wording import listed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF001"
_ALIKE = 0.8
_MOST = 50  # trees that are told of one by one
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


class _Missing(NamedTuple):
    parent: str
    child: str
    misspelt: bool


def find(observation: Observation) -> Iterator[Finding]:
    """One finding for every tree but the largest, and one for all the rest of very many."""
    main, *others = observation.trees or [""]
    by_root: dict[str, list[Edge]] = {}
    for edge in observation.edges:
        by_root.setdefault(observation.root(edge.child), []).append(edge)
    for root in others[:_MOST]:
        link = _missing(observation, main, root)
        members = [frame for frame in observation.trees[root] if frame != root]
        below = f" with {listed(members)}" if members else ""
        edges = by_root.get(root, [])
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{len(observation.trees)} trees: {main!r} with {len(observation.trees[main]) - 1} frames below it, "
            f"and {root!r}{below}; " + _most_likely(link, root),
            fix=_fix(link, root),
            frames=frozenset({root, *observation.trees[root]}),
            first_stamp=min((edge.first_stamp for edge in edges), default=None),
            publishers=tuple(dict.fromkeys(name for edge in edges for name in edge.publishers)),
        )
    if rest := others[_MOST:]:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{len(rest)} more trees: {listed(rest)}; names that are made anew all the time make so many",
            fix="Find the publisher that numbers its frames without end, or give those of one robot one root.",
            frames=frozenset(rest),
            first_stamp=min((edge.first_stamp for root in rest for edge in by_root.get(root, [])), default=None),
        )


def _missing(observation: Observation, main: str, other: str) -> _Missing | None:
    """The most likely link between two trees: a misspelt name, or what is usual."""
    for root, frames in ((other, observation.trees[main]), (main, observation.trees[other])):
        alike = [
            frame
            for frame in difflib.get_close_matches(root, frames[:_COMPARED], n=3, cutoff=_ALIKE)
            if _is_slip(root, frame)
        ]
        if alike:
            return _Missing(alike[0], root, misspelt=True)
    for parent, child in _USUAL:
        for root, frames in ((other, observation.trees[main]), (main, observation.trees[other])):
            above = [frame for frame in frames if _bare(frame) == parent and _prefix(frame) == _prefix(root)]
            if _bare(root) == child and above:
                return _Missing(above[0], root, misspelt=False)
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


def _most_likely(link: _Missing | None, root: str) -> str:
    if link is None:
        return f"nobody tells where {root!r} is"
    if link.misspelt:
        return f"{link.child!r} looks like {link.parent!r} misspelt"
    return f"most likely {link.parent} -> {link.child} is missing"


def _fix(link: _Missing | None, root: str) -> str:
    if link is None:
        return (
            f"Publish a transform with child_frame_id = {root!r}; if it never moves: "
            f"coframe static --frame-id PARENT --child-frame-id {root}"
        )
    if link.misspelt:
        return (
            f"In the node that sends {link.child!r}, change the line to t.header.frame_id = {link.parent!r} "
            f"(or t.child_frame_id); the two names must be the same."
        )
    return (
        f"Start the node that publishes {link.parent} -> {link.child}; if it never moves: "
        f"coframe static --frame-id {link.parent} --child-frame-id {link.child}"
    )
