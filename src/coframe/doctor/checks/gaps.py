"""TF013: links that are told of too rarely, with gaps, or no longer."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.analysis.liveness import usual_gap, usual_silence
from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import listed, static_arguments
from coframe.formatting import duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF013"
_MS = 1_000_000
_SLOW = 400 * _MS  # between transforms of a link that moves
_LEAST = 5


def find(observation: Observation) -> Iterator[Finding]:
    """Links that share a gap are told of together."""
    edges = [edge for edge in observation.dynamic if edge.count >= _LEAST and edge.period]
    silent = [
        edge
        for edge in edges
        if observation.last[edge.child] is edge and _silence(observation, edge) > usual_silence(edge.period)
    ]
    slow = [edge for edge in edges if edge.period > _SLOW]
    gaps = [edge for edge in edges if int(edge.intervals.max()) > usual_gap(edge.period)]
    for edge in slow:
        yield _finding(
            [edge],
            Severity.NOTE if edge.constant else Severity.WARNING,
            f"only every {duration(edge.period)}: a look-up at now() waits as long, or fails",
            "Send it at 10 Hz or more"
            + (
                f"; as it never changes, better once: coframe static {static_arguments(edge)}"
                if edge.constant
                else ": self.create_timer(0.02, self.broadcast)."
            ),
            edge.first_stamp,
        )
    if gaps:
        worst = max(gaps, key=lambda edge: int(edge.intervals.max()))
        row = int(np.argmax(worst.intervals))
        yield _finding(
            gaps,
            Severity.WARNING,
            f"a gap of {duration(int(worst.intervals.max()))} where {duration(worst.period)} is usual"
            + _on(gaps)
            + "; in between tf2 interpolates over it",
            "Find out what kept the publisher: a callback that blocks (time.sleep, a service call), a full "
            "processor, a "
            "lossy network; give its timer a thread of its own (MultiThreadedExecutor).",
            int(np.unique(worst.stamp)[row]),
        )
    if silent:
        worst = max(silent, key=lambda edge: _silence(observation, edge))
        yield _finding(
            silent,
            Severity.WARNING,
            f"nothing for the last {duration(_silence(observation, worst))}, after every {duration(worst.period)} "
            "before" + _on(silent),
            "Start its publisher again"
            + (f" ({listed(worst.publishers)})" if worst.publishers else "")
            + "; look-ups at now() fail, those of the latest time give an old pose.",
            int(worst.stamp[-1]),
        )


def _silence(observation: Observation, edge: Edge) -> int:
    return observation.end - int(edge.arrived[-1])


def _on(edges: list[Edge]) -> str:
    others = [f"{edge.parent} -> {edge.child}" for edge in edges]
    return f" (on {len(edges)} links: {listed(others)})" if len(edges) > 1 else ""


def _finding(edges: list[Edge], severity: Severity, text: str, fix: str, stamp: int) -> Finding:
    return Finding(
        code=CODE,
        severity=severity,
        text=text,
        fix=fix,
        edge=edges[0].key,
        frames=frozenset(name for edge in edges for name in edge.key),
        first_stamp=stamp,
        publishers=tuple(dict.fromkeys(name for edge in edges for name in edge.publishers)),
    )
