# SPDX-License-Identifier: Apache-2.0
"""TF001: trees that no chain of transforms connects, and the edge that is most likely missing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import count, listed
from coframe.analysis.missing_edges import missing_edge, unknown_mount
from coframe.doctor._edge import publishers_of
from coframe.doctor._finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF001"
_MAX_TREES = 50  # maximum number of trees with a separate finding


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding for every tree but the largest, and one for all trees beyond a limit."""
    main, *others = observation.trees or [""]
    by_root: dict[str, list[Edge]] = {}
    for edge in observation.edges:
        by_root.setdefault(observation.root(edge.child), []).append(edge)
    for root in others[:_MAX_TREES]:
        missing = missing_edge(_from_root(observation, main), _from_root(observation, root))
        members = [frame for frame in observation.trees[root] if frame != root]
        below = f" with {listed(members)}" if members else ""
        edges = by_root.get(root, [])
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{len(observation.trees)} separate trees: {main!r} with "
            f"{count(len(observation.trees[main]) - 1, 'frame')} below it, and {root!r}{below}; "
            + (missing.text if missing else f"no transform to {root!r} is published"),
            fix=missing.fix if missing else unknown_mount(root),
            frames=frozenset({root, *observation.trees[root]}),
            first_stamp=min((edge.first_stamp for edge in edges), default=None),
            publishers=publishers_of(edges),
        )
    if rest := others[_MAX_TREES:]:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{len(rest)} more trees: {listed(rest)}; a publisher may keep creating frame names",
            fix="Find the publisher that creates new frame names, or connect the frames of one robot to one root.",
            frames=frozenset(rest),
            first_stamp=min((edge.first_stamp for root in rest for edge in by_root.get(root, [])), default=None),
        )


def _from_root(observation: Observation, root: str) -> list[str]:
    return [root, *(frame for frame in observation.trees[root] if frame != root)]
