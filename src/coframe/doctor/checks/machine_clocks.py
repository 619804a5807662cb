"""TF010: machines whose clocks differ."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import listed
from coframe.formatting import duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF010"
_MS = 1_000_000
_LEAST = 20  # messages
# What arrives before it was sent, by the two clocks, proves a difference; a network may well take a while.
_AHEAD = 1 * _MS
_BEHIND = 100 * _MS
# Stamps of one machine are off by the same time, nearly.
_STEADY = 20 * _MS
_FIX = (
    "Set the clocks of all machines right: install chrony and let one of them be the server; `chronyc tracking` tells."
)


def find(observation: Observation) -> Iterator[Finding]:
    """By the times at which messages were sent where these are known, else by stamps that are steadily off."""
    if observation.live:
        yield from _by_travel(observation)
    else:
        yield from _by_stamps(observation)


def _by_travel(observation: Observation) -> Iterator[Finding]:
    for publisher, travel in observation.travel.items():
        if len(travel) < _LEAST or not publisher:
            continue
        least = int(travel.min())
        if -_AHEAD < least < _BEHIND:
            continue
        frames = {name for edge in observation.edges if publisher in edge.publishers for name in edge.key}
        off = f"{duration(abs(least))} {'ahead of' if least < 0 else 'behind'} this machine's"
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"the clock of the machine of {publisher} is at least {off}",
            fix=_FIX,
            frames=frozenset(frames),
            publishers=(publisher,),
        )


def _by_stamps(observation: Observation) -> Iterator[Finding]:
    """Two links or more that share an offset which the others do not have."""
    offsets: list[tuple[float, Edge]] = []
    for edge in observation.dynamic:
        lags = observation.lags(edge.stamp, edge.arrived)
        if lags is not None and edge.count >= _LEAST:
            middle = float(np.median(lags))
            if np.median(np.abs(lags - middle)) < _STEADY:
                offsets.append((middle, edge))
    right = [edge for offset, edge in offsets if abs(offset) < _BEHIND]
    off = sorted(((offset, edge) for offset, edge in offsets if abs(offset) >= _BEHIND), key=lambda pair: pair[0])
    if not right or len(off) < 2 or off[-1][0] - off[0][0] > _STEADY:
        return
    edges = [edge for _, edge in off]
    middle = float(np.median([offset for offset, _ in off]))
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"{listed(f'{edge.parent} -> {edge.child}' for edge in edges)} are all {duration(abs(middle))} "
        f"{'ahead' if middle < 0 else 'behind'} when they arrive, others are not: the clock of their machine is off",
        fix=_FIX,
        edge=edges[0].key,
        frames=frozenset(name for edge in edges for name in edge.key),
        first_stamp=edges[0].first_stamp,
        publishers=tuple(dict.fromkeys(name for edge in edges for name in edge.publishers)),
    )
