"""TF013: edges with a low rate, with gaps, or without recent transforms."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.analysis.liveness import usual_gap
from coframe.analysis.static_command import static_command
from coframe.doctor.edge import publishers_of
from coframe.doctor.finding import Finding, Severity
from coframe.formatting import duration, listed
from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF013"
_SLOW = 400 * MILLISECOND  # the longest period of a moving edge that is not a finding
_LEAST = 5  # transforms from which a rate and gaps can be judged


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per slow edge, one for all gaps, and one for all stale edges."""
    edges = [edge for edge in observation.dynamic if edge.count >= _LEAST and edge.period]
    slow = [edge for edge in edges if edge.period > _SLOW]
    gaps = [edge for edge in edges if int(edge.intervals.max()) > usual_gap(edge.period)]
    stale = [edge for edge in observation.dynamic if observation.is_stale(edge)]
    yield from map(_slow, slow)
    if gaps:
        yield _gaps(gaps)
    if stale:
        yield _stale(observation, stale)


def _slow(edge: Edge) -> Finding:
    command = static_command(*edge.key, edge.values[-1].tolist())
    return _finding(
        [edge],
        Severity.NOTE if edge.constant else Severity.WARNING,
        f"published only every {duration(edge.period)}; a lookup at now() has to wait that long, or fails",
        "Publish it at 10 Hz or more"
        + (
            f"; as it never changes, better publish it once as static: `{command}`."
            if edge.constant
            else ": self.create_timer(0.02, self.broadcast)."
        ),
        edge.first_stamp,
    )


def _gaps(edges: list[Edge]) -> Finding:
    worst = max(edges, key=lambda edge: int(edge.intervals.max()))
    row = int(np.argmax(worst.intervals))
    return _finding(
        edges,
        Severity.WARNING,
        f"a gap of {duration(int(worst.intervals.max()))}; the usual period is {duration(worst.period)}{_all(edges)}; "
        "tf2 interpolates across the gap",
        "Find out what delayed the publisher: a blocking callback (time.sleep, a service call), an overloaded "
        "processor, or a lossy network. Give its timer a thread of its own (MultiThreadedExecutor).",
        int(np.unique(worst.stamp)[row]),
    )


def _stale(observation: Observation, edges: list[Edge]) -> Finding:
    worst = max(edges, key=observation.silence)
    usual = f"; the usual period is {duration(worst.period)}" if worst.period else ""
    publishers = f" ({listed(worst.publishers)})" if worst.publishers else ""
    return _finding(
        edges,
        Severity.WARNING,
        f"stale: no transform for the last {duration(observation.silence(worst))}{usual}{_all(edges)}",
        f"Restart the publisher{publishers}. Until then lookups at now() fail, and the latest transform is outdated.",
        int(worst.stamp[-1]),
    )


def _all(edges: list[Edge]) -> str:
    return f" (on {len(edges)} edges: {listed(edge.name for edge in edges)})" if len(edges) > 1 else ""


def _finding(edges: list[Edge], severity: Severity, text: str, fix: str, stamp: int) -> Finding:
    return Finding(
        code=CODE,
        severity=severity,
        text=text,
        fix=fix,
        edge=edges[0].key,
        frames=frozenset(name for edge in edges for name in edge.key),
        first_stamp=stamp,
        publishers=publishers_of(edges),
    )
