"""What lies on the timeline: how many samples each edge has where, its gaps, and the next stamp to step to."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.analysis.liveness import usual_gap, usual_period
from coframe.errors import TransformException

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from coframe import Buffer, FrameInfo
    from coframe.viewer.sources.messages import Messages

__all__ = ["MOST_BINS", "edge_rows", "next_stamp"]

MOST_BINS = 2000
_MOST_GAPS = 200
_NS = 1_000_000_000


def edge_rows(
    buffer: Buffer, infos: list[FrameInfo], first: int, last: int, bins: int, origin: int
) -> list[dict[str, Any]]:
    """For each dynamic edge its samples a bin between two times in nanoseconds, and where it has none for long."""
    borders = np.linspace(0.0, float(last - first), bins + 1)
    rows = []
    for index, info in enumerate(infos):
        if not info.parent or info.static:
            continue
        stamps = _stamps(buffer, info, first, last)
        counts = np.histogram((stamps - first).astype(np.float64), borders)[0]
        packed = np.minimum(counts, 0xFFFF).astype("<u2").tobytes()
        rows.append({"frame": index, "counts": base64.b64encode(packed).decode(), "gaps": _gaps(stamps, origin)})
    return rows


def next_stamp(
    buffer: Buffer, infos: list[FrameInfo], topics: Iterable[Messages], at: int, direction: int
) -> int | None:
    """The nearest stamp of a transform or displayed message after a time, or before it; None if there is none."""
    candidates = []
    for info in infos:
        if info.parent and not info.static and info.samples:
            found = _next_on_edge(buffer, info, at, direction)
            if found is not None:
                candidates.append(found)
    for messages in topics:
        times = messages.times()
        beyond = times[times > at] if direction > 0 else times[times < at]
        if len(beyond):
            candidates.append(int(beyond.min() if direction > 0 else beyond.max()))
    if not candidates:
        return None
    return min(candidates) if direction > 0 else max(candidates)


def _next_on_edge(buffer: Buffer, info: FrameInfo, at: int, direction: int) -> int | None:
    """Looks further and further away, so that no more samples are fetched than needed."""
    reach = max(1, round(2.0 * _NS / info.rate)) if info.rate > 0.0 else _NS
    while True:
        if direction > 0:
            first, last = max(at + 1, info.oldest), max(at, info.oldest) + reach
        else:
            first, last = min(at, info.newest) - reach, min(at - 1, info.newest)
        stamps = _stamps(buffer, info, first, last)
        if len(stamps):
            return int(stamps[0] if direction > 0 else stamps[-1])
        if last >= info.newest if direction > 0 else first <= info.oldest:
            return None
        reach *= 8


def _stamps(buffer: Buffer, info: FrameInfo, first: int, last: int) -> NDArray[np.int64]:
    """The stamps of an edge's samples between two times; none where its parent has changed."""
    try:
        return np.frombuffer(buffer._stamps_between(info.parent, info.name, first, last), np.int64)
    except TransformException:
        return np.zeros(0, np.int64)


def _gaps(stamps: NDArray[np.int64], origin: int) -> list[list[int]]:
    if len(stamps) < 3:
        return []
    before = np.flatnonzero(np.diff(stamps) > usual_gap(usual_period(stamps)))[:_MOST_GAPS]
    return [[int(stamps[i]) - origin, int(stamps[i + 1]) - origin] for i in before]
