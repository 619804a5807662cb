# SPDX-License-Identifier: Apache-2.0
"""The timeline: the number of samples of each edge over time, its gaps, and the next stamp to step to."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING

import numpy as np

from coframe.analysis.liveness import usual_gap, usual_period
from coframe.errors import TransformException
from coframe.time import SECOND
from coframe.viewer.protocol.server_messages import TimelineEdge

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from coframe.buffer.buffer import Buffer
    from coframe.buffer.edge_info import FrameInfo
    from coframe.viewer.protocol.common import Span
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = ["edge_rows", "next_stamp"]

_MAX_GAPS = 200


def edge_rows(
    buffer: Buffer, infos: list[FrameInfo], first: int, last: int, bins: int, origin: int
) -> list[TimelineEdge]:
    """Return for each dynamic edge the number of samples per bin and the gaps.

    Args:
        buffer: The buffer that contains the edges.
        infos: Its frames; edges are named by the index of their child frame.
        first: The start of the first bin, in nanoseconds.
        last: The end of the last bin, in nanoseconds.
        bins: The number of bins.
        origin: The origin of the times in the result, in nanoseconds.
    """
    borders = np.linspace(0.0, float(last - first), bins + 1)
    rows = []
    for index, info in enumerate(infos):
        if not info.parent or info.static:
            continue
        stamps = _stamps(buffer, info, first, last)
        counts = np.histogram((stamps - first).astype(np.float64), borders)[0]
        packed = np.minimum(counts, 0xFFFF).astype("<u2").tobytes()
        text = base64.b64encode(packed).decode()
        rows.append(TimelineEdge(frame=index, counts=text, gaps=_gaps(stamps, origin)))
    return rows


def next_stamp(
    buffer: Buffer, infos: list[FrameInfo], topics: Iterable[TopicMessages], at: int, direction: int
) -> int | None:
    """Return the nearest stamp of a transform or a displayed message after or before a time.

    Args:
        buffer: The buffer that contains the transforms.
        infos: Its frames.
        topics: The displayed messages.
        at: The time in nanoseconds.
        direction: 1 for the next stamp, -1 for the previous one.

    Returns:
        The stamp in nanoseconds, or None if there is none.
    """
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
    """Search in a growing interval, so that few samples are fetched."""
    length = max(1, round(2.0 * SECOND / info.rate)) if info.rate > 0.0 else SECOND
    while True:
        if direction > 0:
            first, last = max(at + 1, info.oldest), max(at, info.oldest) + length
        else:
            first, last = min(at, info.newest) - length, min(at - 1, info.newest)
        stamps = _stamps(buffer, info, first, last)
        if len(stamps):
            return int(stamps[0] if direction > 0 else stamps[-1])
        if last >= info.newest if direction > 0 else first <= info.oldest:
            return None
        length *= 8


def _stamps(buffer: Buffer, info: FrameInfo, first: int, last: int) -> NDArray[np.int64]:
    """Return the stamps of an edge's samples between two times; none if its parent has changed."""
    try:
        return np.frombuffer(buffer._stamps_between(info.parent, info.name, first, last), np.int64)
    except TransformException:
        return np.zeros(0, np.int64)


def _gaps(stamps: NDArray[np.int64], origin: int) -> list[Span]:
    if len(stamps) < 3:
        return []
    before = np.flatnonzero(np.diff(stamps) > usual_gap(usual_period(stamps)))[:_MAX_GAPS]
    return [(int(stamps[i]) - origin, int(stamps[i + 1]) - origin) for i in before]
