"""Figures of links: rate, jitter, delay and age by publisher, and what limits the way between two frames."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["ChainFigures", "EdgeFigures", "PublisherFigures", "chain_figures", "edge_figures", "publisher_figures"]

_SECOND = 1e9
_SAMPLES = 1000


class EdgeFigures(NamedTuple):
    """What one publisher tells of one link. Times are nanoseconds; None where they mean nothing.

    Attributes:
        parent: The frame that it is told in.
        child: The frame that it tells of.
        publisher: The full name of the node; "" where it is not known.
        static: Valid for all time: then there is neither rate nor delay nor age.
        transforms: How many came.
        rate: So many a second, as they arrived.
        jitter: Standard deviation of the intervals between arrivals.
        delay: From stamp to arrival, the mean; negative if it is stamped ahead.
        delay_p99: 99 of 100 arrive within this.
        delay_max: All of them do.
        age: From the newest stamp to now.
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


class PublisherFigures(NamedTuple):
    """What one node sends: messages a second, and the delay of its transforms in nanoseconds."""

    publisher: str
    messages: int
    rate: float | None
    delay: float | None
    delay_p99: float | None
    delay_max: float | None


class ChainFigures(NamedTuple):
    """The way between two frames. Times are nanoseconds.

    Attributes:
        frames: From the target to the source.
        delay: How old the newest time is that all links know, the mean over the time of listening; None if nothing
            moves, or before all links have been told of.
        delay_p99: 99 of 100 times it is no older.
        delay_max: The oldest.
        limit: The link that was the last to be known most of the time, as (parent, child); None if nothing moves.
        limit_share: How much of the time it was that one, from 0 to 1.
    """

    frames: list[str]
    delay: float | None
    delay_p99: float | None
    delay_max: float | None
    limit: tuple[str, str] | None
    limit_share: float


def edge_figures(observation: Observation) -> list[EdgeFigures]:
    """One row a link and publisher, in the order in which they came up."""
    return [
        _link(observation, edge, publisher, edge.publisher == publisher)
        for edge in observation.edges
        for publisher in dict.fromkeys(edge.publisher.tolist())
    ]


def publisher_figures(observation: Observation) -> list[PublisherFigures]:
    """One row a node that sends moving transforms."""
    told = observation.transforms
    rows = []
    for number in np.unique(told.publisher[~told.static]).tolist():
        arrived = np.unique(told.arrived[(told.publisher == number) & ~told.static])
        edges = [(edge, edge.publisher == number) for edge in observation.dynamic]
        lags = [
            lag
            for edge, mine in edges
            if mine.any() and (lag := observation.lags(edge.stamp[mine], edge.arrived[mine])) is not None
        ]
        delays = np.concatenate(lags) if lags else None
        rows.append(PublisherFigures(told.publishers[number], len(arrived), _rate(arrived), *_delays(delays)))
    return rows


def chain_figures(observation: Observation, target: str, source: str) -> ChainFigures | None:
    """The way between two frames; None if there is none."""
    up, down = observation.path(target), observation.path(source)
    if target != source and observation.root(target) != observation.root(source):
        return None
    shared = {edge.key for edge in up} & {edge.key for edge in down}
    up = [edge for edge in up if edge.key not in shared]
    down = [edge for edge in down if edge.key not in shared]
    top = up[-1].parent if up else down[-1].parent if down else target
    frames = [*(edge.child for edge in up), top, *(edge.child for edge in reversed(down))]
    moving = [edge for edge in (*up, *down) if not edge.static]
    begun = max((int(edge.arrived[0]) for edge in moving), default=observation.end)
    if not moving or begun >= observation.end:
        return ChainFigures(frames, None, None, None, None, 0.0)
    times = np.linspace(begun, observation.end, _SAMPLES).astype(np.int64)
    newest = np.array([_newest(edge, times) for edge in moving])
    last = newest.argmin(axis=0)
    delays = observation.lags(newest.min(axis=0), times)
    counts = np.bincount(last, minlength=len(moving))
    limit = int(counts.argmax())
    return ChainFigures(frames, *_delays(delays), moving[limit].key, float(counts[limit] / len(times)))


def _newest(edge: Edge, times: NDArray[np.int64]) -> NDArray[np.int64]:
    """The newest stamp that was known at each of these times."""
    row = np.searchsorted(edge.arrived, times, side="right") - 1
    return np.asarray(np.maximum.accumulate(edge.stamp)[np.maximum(row, 0)])


def _link(observation: Observation, edge: Edge, publisher: int, rows: NDArray[np.bool_]) -> EdgeFigures:
    names = observation.transforms.publishers
    count = int(np.count_nonzero(rows))
    if edge.static:
        return EdgeFigures(edge.parent, edge.child, names[publisher], True, count, *[None] * 6)
    stamp, arrived = edge.stamp[rows], edge.arrived[rows]
    age = observation.lags(np.array([stamp.max()]), np.array([observation.end]))
    jitter = float(np.std(arrived[1:] - arrived[:-1])) if count > 2 else None
    return EdgeFigures(
        edge.parent,
        edge.child,
        names[publisher],
        False,
        count,
        _rate(arrived),
        jitter,
        *_delays(observation.lags(stamp, arrived)),
        int(age[0]) if age is not None else None,
    )


def _rate(arrived: NDArray[np.int64]) -> float | None:
    if len(arrived) < 2 or arrived[-1] == arrived[0]:
        return None
    return (len(arrived) - 1) * _SECOND / float(arrived[-1] - arrived[0])


def _delays(lags: NDArray[np.int64] | None) -> tuple[float | None, float | None, float | None]:
    """Mean, 99th percentile, and the longest."""
    if lags is None or not len(lags):
        return None, None, None
    return float(np.mean(lags)), float(np.percentile(lags, 99)), float(np.max(lags))
