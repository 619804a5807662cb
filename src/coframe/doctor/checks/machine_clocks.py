# SPDX-License-Identifier: Apache-2.0
"""TF010: machines with different clocks."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import duration, join_names
from coframe.doctor._edge import publishers_of
from coframe.doctor._finding import Finding, Severity
from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF010"
_MIN_MESSAGES = 20  # messages
# A message that arrives before it was sent proves that the clocks differ; a network may take 100 ms.
_MAX_LEAD = 1 * MILLISECOND
_MAX_LAG = 100 * MILLISECOND
# The stamps of one machine are off by nearly the same amount.
_MAX_SPREAD = 20 * MILLISECOND
_FIX = (
    "Synchronize the clocks of all machines: install chrony and make one machine the server of the others; check with "
    "`chronyc tracking`."
)


def find(observation: Observation) -> Iterator[Finding]:
    """Yield findings based on the send times of messages if known, else on constant stamp offsets."""
    if observation.live:
        yield from _find_by_transport_time(observation)
    else:
        yield from _find_by_stamps(observation)


def _find_by_transport_time(observation: Observation) -> Iterator[Finding]:
    for publisher, travel in observation.travel.items():
        if len(travel) < _MIN_MESSAGES or not publisher:
            continue
        least = int(travel.min())
        if -_MAX_LEAD < least < _MAX_LAG:
            continue
        frames = {name for edge in observation.edges if publisher in edge.publishers for name in edge.key}
        offset = f"{duration(abs(least))} {'ahead of' if least < 0 else 'behind'}"
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"the clock of the machine of {publisher} is at least {offset} the clock of this machine",
            fix=_FIX,
            frames=frozenset(frames),
            publishers=(publisher,),
        )


def _find_by_stamps(observation: Observation) -> Iterator[Finding]:
    """Yield a finding if two or more edges share an offset that the others do not have."""
    offsets: list[tuple[float, Edge]] = []
    for edge in observation.dynamic:
        lags = observation.lags(edge.stamp, edge.arrived)
        if lags is not None and edge.count >= _MIN_MESSAGES:
            median = float(np.median(lags))
            if np.median(np.abs(lags - median)) < _MAX_SPREAD:
                offsets.append((median, edge))
    correct = [edge for offset, edge in offsets if abs(offset) < _MAX_LAG]
    wrong_offsets = sorted(
        ((offset, edge) for offset, edge in offsets if abs(offset) >= _MAX_LAG), key=lambda pair: pair[0]
    )
    if not correct or len(wrong_offsets) < 2 or wrong_offsets[-1][0] - wrong_offsets[0][0] > _MAX_SPREAD:
        return
    edges = [edge for _, edge in wrong_offsets]
    shared = observation.offset(edges[len(edges) // 2].name)
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"the stamps of {join_names(edge.name for edge in edges)} are all {shared.size} "
        f"{shared.direction} their arrival, but those of other edges are not: the clock of "
        "their machine is wrong",
        fix=_FIX,
        edge=edges[0].key,
        edges=tuple(edge.key for edge in edges),
        frames=frozenset(name for edge in edges for name in edge.key),
        first_stamp=edges[0].first_stamp,
        publishers=publishers_of(edges),
    )
