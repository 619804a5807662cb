# SPDX-License-Identifier: Apache-2.0
"""TF001: trees that no chain of transforms connects, and the edge that is most likely missing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import count, join_names, join_quoted
from coframe.analysis.missing_edges import missing_edge, unknown_mount
from coframe.doctor._edge import publishers_of
from coframe.doctor._finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF001"
_MIN_SIMILAR_TREES = 3  # trees that one finding lists
_MAX_TREES = 50  # Robots have fewer.


def find(observation: Observation) -> Iterator[Finding]:
    """Yield a finding for every tree except the largest. Many trees without a likely edge share one finding."""
    main, *others = observation.trees or [""]
    by_root: dict[str, list[Edge]] = {}
    for edge in observation.edges:
        by_root.setdefault(observation.root(edge.child), []).append(edge)
    candidates = others[:_MAX_TREES]
    likely = {
        root: missing_edge(_frames_from_root(observation, main), _frames_from_root(observation, root))
        for root in candidates
    }
    unknown = [root for root in others if likely.get(root) is None]
    if len(unknown) >= _MIN_SIMILAR_TREES:
        yield _several_trees_finding(observation, main, unknown, by_root)
    for root in others:
        missing = likely.get(root)
        if missing is None and len(unknown) >= _MIN_SIMILAR_TREES:
            continue
        members = [frame for frame in observation.trees[root] if frame != root]
        below = f" with {join_names(members)}" if members else ""
        edges = by_root.get(root, [])
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{_trees_text(observation, main)}, and {root!r}{below}; "
            + (missing.text if missing else f"no transform to {root!r} is published"),
            fix=missing.fix if missing else unknown_mount(root),
            frames=frozenset({root, *observation.trees[root]}),
            first_stamp=min((edge.first_stamp for edge in edges), default=None),
            publishers=publishers_of(edges),
        )


def _several_trees_finding(
    observation: Observation, main: str, roots: list[str], by_root: dict[str, list[Edge]]
) -> Finding:
    """Return one finding for several trees that no likely edge connects with the largest one."""
    edges = [edge for root in roots for edge in by_root.get(root, [])]
    creates = "; a publisher may keep creating frame names" if len(roots) > _MAX_TREES else ""
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"{_trees_text(observation, main)}, and {len(roots)} trees to whose roots no transform is published: "
        f"{join_quoted(roots)}{creates}",
        fix="Find the publisher that creates new frame names, or connect the frames of one robot to one root."
        if creates
        else f"{unknown_mount(roots[0])} Do the same for the other roots.",
        frames=frozenset(frame for root in roots for frame in (root, *observation.trees[root])),
        first_stamp=min((edge.first_stamp for edge in edges), default=None),
        publishers=publishers_of(edges),
    )


def _trees_text(observation: Observation, main: str) -> str:
    below = count(len(observation.trees[main]) - 1, "frame")
    return f"{len(observation.trees)} separate trees: {main!r} with {below} below it"


def _frames_from_root(observation: Observation, root: str) -> list[str]:
    return [root, *(frame for frame in observation.trees[root] if frame != root)]
