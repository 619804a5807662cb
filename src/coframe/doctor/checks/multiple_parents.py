# SPDX-License-Identifier: Apache-2.0
"""TF002: a frame with more than one parent."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import join_names, times
from coframe.doctor._edge import publishers_of
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._rules import drop_edge

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF002"
# A grasped object changes its parent a few times; publishers that disagree alternate continuously.
_CHANGES = 3


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per frame."""
    by_child: dict[str, list[Edge]] = {}
    for edge in observation.edges:
        by_child.setdefault(edge.child, []).append(edge)
    for child, edges in by_child.items():
        if len({edge.parent for edge in edges}) > 1:
            yield _make_finding(child, edges)


def _make_finding(child: str, edges: list[Edge]) -> Finding:
    changes = _changes(edges)
    disagree = changes >= _CHANGES or any(edge.static for edge in edges)
    parents = "; ".join(f"{edge.parent!r} {times(edge.count)} ({_source_text(edge)})" for edge in edges)
    latest = max(edges, key=lambda edge: int(edge.arrived[-1]))
    others = [edge for edge in edges if edge.parent != latest.parent]
    return Finding(
        code=CODE,
        severity=Severity.ERROR if disagree else Severity.NOTE,
        text=f"{child!r} has more than one parent: {parents}; the parent changed {times(changes)}",
        fix=f"Publish {child!r} from only one node: stop the other one, or give its frame another name "
        f"(t.child_frame_id = {child + '_2'!r}), or invert its transform: t.header.frame_id = {child!r}, "
        f"t.child_frame_id = {others[0].parent!r}."
        if disagree
        else "No change is needed if the frame is meant to change its parent; otherwise stop one of the publishers.",
        harm=""
        if disagree
        else "tf2 does not interpolate between the last transform with one parent and the first with the other.",
        edge=latest.key,
        frames=frozenset(edge.parent for edge in edges),
        first_stamp=max(edge.first_stamp for edge in edges),
        publishers=publishers_of(edges),
        choices=tuple(drop_edge(edge.key) for edge in edges),
    )


def _changes(edges: list[Edge]) -> int:
    arrival_times = np.concatenate([edge.arrived for edge in edges])
    parent = np.concatenate([np.full(edge.count, hash(edge.parent)) for edge in edges])
    return int(np.count_nonzero(np.diff(parent[np.argsort(arrival_times, kind="stable")])))


def _source_text(edge: Edge) -> str:
    topic = "static" if edge.static else "dynamic"
    return f"{topic}, from {join_names(edge.publishers)}" if edge.publishers else topic
