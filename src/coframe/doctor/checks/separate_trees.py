"""TF001: frames that no chain of transforms connects, and the link that is most likely missing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.analysis.missing_edges import missing_edge, unknown_mount
from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import listed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF001"
_MOST = 50  # trees that are told of one by one


def find(observation: Observation) -> Iterator[Finding]:
    """One finding for every tree but the largest, and one for all the rest of very many."""
    main, *others = observation.trees or [""]
    by_root: dict[str, list[Edge]] = {}
    for edge in observation.edges:
        by_root.setdefault(observation.root(edge.child), []).append(edge)
    for root in others[:_MOST]:
        link = missing_edge(_from_root(observation, main), _from_root(observation, root))
        members = [frame for frame in observation.trees[root] if frame != root]
        below = f" with {listed(members)}" if members else ""
        edges = by_root.get(root, [])
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{len(observation.trees)} trees: {main!r} with {len(observation.trees[main]) - 1} frames below it, "
            f"and {root!r}{below}; " + (link.text if link else f"nobody tells where {root!r} is"),
            fix=link.fix if link else unknown_mount(root),
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


def _from_root(observation: Observation, root: str) -> list[str]:
    return [root, *(frame for frame in observation.trees[root] if frame != root)]
