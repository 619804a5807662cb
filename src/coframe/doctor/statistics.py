# SPDX-License-Identifier: Apache-2.0
"""Statistics of edges: rate, jitter, delay and age per publisher, and the edge that limits a chain."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe.time import SECOND

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = [
    "ChainStatistics",
    "EdgeStatistics",
    "PublisherStatistics",
    "chain_statistics",
    "edge_statistics",
    "publisher_statistics",
]

_CHAIN_SAMPLES = 1000


class EdgeStatistics(NamedTuple):
    """The transforms of one edge from one publisher. Times are nanoseconds, or None where undefined.

    Attributes:
        parent: The parent frame.
        child: The child frame.
        publisher: The full name of the node, or "" if it is unknown.
        static: Whether the edge is static, so that rate, delay and age are undefined.
        transforms: The number of transforms.
        rate: Transforms per second, by their arrival.
        jitter: Standard deviation of the intervals between arrivals.
        delay: The mean delay from stamp to arrival; negative if stamps are ahead.
        delay_p99: The 99th percentile of the delays.
        delay_max: The longest delay.
        age: The time from the newest stamp to the end of the observation.
        stale: Whether the edge is stale (see :mod:`coframe.analysis.liveness`), regardless of the publisher.
    """

    parent: str
    child: str
    publisher: str
    static: bool
    transforms: int
    rate: float | None
    jitter: float | None
    delay: float | None
    delay_p99: float | None
    delay_max: float | None
    age: int | None
    stale: bool


class PublisherStatistics(NamedTuple):
    """The messages of one node per second, and the delays of its transforms in nanoseconds."""

    publisher: str
    messages: int
    rate: float | None
    delay: float | None
    delay_p99: float | None
    delay_max: float | None


class ChainStatistics(NamedTuple):
    """The chain between two frames. Times are nanoseconds.

    Attributes:
        frames: The frames from the target to the source.
        delay: The mean age of the latest common time during the observation, or None if all edges are static, or if an
            edge has no data.
        delay_p99: The 99th percentile of this age.
        delay_max: The maximum age.
        limit: The edge, as (parent, child), that limits the latest common time most often, or None if all edges are
            static.
        limit_share: The share of the time for which it does, from 0 to 1.
    """

    frames: list[str]
    delay: float | None
    delay_p99: float | None
    delay_max: float | None
    limit: tuple[str, str] | None
    limit_share: float


def edge_statistics(observation: Observation, limit: int | None = None) -> list[EdgeStatistics]:
    """Return one row per edge and publisher, in the order of their first transform, and at most `limit` rows."""
    every = (
        _edge(observation, edge, publisher, edge.publisher == publisher)
        for edge in observation.edges
        for publisher in dict.fromkeys(edge.publisher.tolist())
    )
    return list(islice(every, limit))


def publisher_statistics(observation: Observation) -> list[PublisherStatistics]:
    """Return one row per node that publishes dynamic transforms."""
    transforms = observation.transforms
    rows = []
    for number in np.unique(transforms.publisher[~transforms.static]).tolist():
        arrival_times = np.unique(transforms.arrived[(transforms.publisher == number) & ~transforms.static])
        edges = [(edge, edge.publisher == number) for edge in observation.dynamic]
        lags = [
            lag
            for edge, own in edges
            if own.any() and (lag := observation.lags(edge.stamp[own], edge.arrived[own])) is not None
        ]
        delays = np.concatenate(lags) if lags else None
        rows.append(
            PublisherStatistics(
                transforms.publishers[number], len(arrival_times), _rate(arrival_times), *_delays(delays)
            )
        )
    return rows


def chain_statistics(observation: Observation, target: str, source: str) -> ChainStatistics | None:
    """Return the statistics of the chain between two frames, or None if they are not connected."""
    frames = observation.structure.chain(target, source)
    if frames is None:
        return None
    on_chain = set(frames)
    edges = [observation.last[frame] for frame in frames if frame in observation.last]
    edges = [edge for edge in edges if edge.parent in on_chain]
    moving_edges = [edge for edge in edges if not edge.static]
    begin = max((int(edge.arrived[0]) for edge in moving_edges), default=observation.end)
    if not moving_edges or begin >= observation.end:
        return ChainStatistics(frames, None, None, None, None, 0.0)
    times = np.linspace(begin, observation.end, _CHAIN_SAMPLES).astype(np.int64)
    newest = np.array([_newest(edge, times) for edge in moving_edges])
    last = newest.argmin(axis=0)
    delays = observation.lags(newest.min(axis=0), times)
    counts = np.bincount(last, minlength=len(moving_edges))
    limit = int(counts.argmax())
    return ChainStatistics(frames, *_delays(delays), moving_edges[limit].key, float(counts[limit] / len(times)))


def _newest(edge: Edge, times: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the newest stamp that had arrived by each of the given times."""
    row = np.searchsorted(edge.arrived, times, side="right") - 1
    return np.asarray(np.maximum.accumulate(edge.stamp)[np.maximum(row, 0)])


def _edge(observation: Observation, edge: Edge, publisher: int, rows: NDArray[np.bool_]) -> EdgeStatistics:
    name = observation.transforms.publishers[publisher]
    count = int(np.count_nonzero(rows))
    if edge.static:
        return EdgeStatistics(edge.parent, edge.child, name, True, count, None, None, None, None, None, None, False)
    stamp, arrival_times = edge.stamp[rows], edge.arrived[rows]
    age = observation.lags(np.array([stamp.max()]), np.array([observation.end]))
    jitter = float(np.std(arrival_times[1:] - arrival_times[:-1])) if count > 2 else None
    return EdgeStatistics(
        edge.parent,
        edge.child,
        name,
        False,
        count,
        _rate(arrival_times),
        jitter,
        *_delays(observation.lags(stamp, arrival_times)),
        int(age[0]) if age is not None else None,
        observation.is_stale(edge),
    )


def _rate(arrival_times: NDArray[np.int64]) -> float | None:
    if len(arrival_times) < 2 or arrival_times[-1] == arrival_times[0]:
        return None
    return (len(arrival_times) - 1) * SECOND / float(arrival_times[-1] - arrival_times[0])


def _delays(lags: NDArray[np.int64] | None) -> tuple[float | None, float | None, float | None]:
    """Return the mean, the 99th percentile and the maximum."""
    if lags is None or not len(lags):
        return None, None, None
    return float(np.mean(lags)), float(np.percentile(lags, 99)), float(np.max(lags))
