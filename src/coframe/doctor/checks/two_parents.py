"""TF002: a frame that is told in two parents; a tree has one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import listed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF002"
# A gripper that takes something changes its parent now and then; who alternates disagrees.
_SWITCHES = 3


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a frame."""
    by_child: dict[str, list[Edge]] = {}
    for edge in observation.edges:
        by_child.setdefault(edge.child, []).append(edge)
    for child, edges in by_child.items():
        if len({edge.parent for edge in edges}) > 1:
            yield _finding(child, edges)


def _finding(child: str, edges: list[Edge]) -> Finding:
    switches = _switches(edges)
    disagree = switches >= _SWITCHES or any(edge.static for edge in edges)
    told = "; ".join(f"{edge.parent!r} {edge.count} times{_by(edge)}" for edge in edges)
    latest = max(edges, key=lambda edge: int(edge.arrived[-1]))
    others = [edge for edge in edges if edge.parent != latest.parent]
    return Finding(
        code=CODE,
        severity=Severity.ERROR if disagree else Severity.NOTE,
        text=f"{child!r} has the parents {told}; the parent changed {switches} times",
        fix=f"Let one of them publish {child!r} only: stop the other, or give its frame a name of its own "
        f"(t.child_frame_id = {child + '_2'!r}), or turn its transform round: "
        f"t.header.frame_id = {child!r}, t.child_frame_id = {others[0].parent!r}."
        if disagree
        else "Nothing, if the frame is meant to change its parent; else stop one of the publishers.",
        harm=""
        if disagree
        else "Between the last transform in the one parent and the first in the other tf2 does not interpolate.",
        edge=latest.key,
        frames=frozenset(edge.parent for edge in edges),
        first_stamp=max(edge.first_stamp for edge in edges),
        publishers=tuple(dict.fromkeys(name for edge in edges for name in edge.publishers)),
    )


def _switches(edges: list[Edge]) -> int:
    arrived = np.concatenate([edge.arrived for edge in edges])
    parent = np.concatenate([np.full(edge.count, hash(edge.parent)) for edge in edges])
    return int(np.count_nonzero(np.diff(parent[np.argsort(arrived, kind="stable")])))


def _by(edge: Edge) -> str:
    topic = "static" if edge.static else "moving"
    return f" ({topic}, by {listed(edge.publishers)})" if edge.publishers else f" ({topic})"
