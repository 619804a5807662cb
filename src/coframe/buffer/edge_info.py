# SPDX-License-Identifier: Apache-2.0
"""The state of the frames and edges of a buffer, as values and as a table for notebooks."""

from __future__ import annotations

import time as system_time
from typing import TYPE_CHECKING, NamedTuple

from coframe import time
from coframe._output import html_tables
from coframe._output.formatting import seconds
from coframe.analysis.clocks import current_time_for
from coframe.analysis.liveness import buffered_period, is_stale

if TYPE_CHECKING:
    from coframe.buffer.buffer import Buffer


class FrameInfo(NamedTuple):
    """The state of one frame in a buffer.

    Attributes:
        name: Name of the frame.
        parent: Parent frame of the newest sample, or "" for the root of a tree or before any data.
        static: Whether the transform is valid for all time.
        samples: Number of samples in the buffer.
        oldest: Stamp of the oldest sample in nanoseconds, or 0 if static or without data.
        newest: Stamp of the newest sample in nanoseconds, or 0 if static or without data.
        rate: Samples per second over the length of the cache, as tf2 computes it, or 0 if static.
        authority: Publisher of the newest sample.
    """

    name: str
    parent: str
    static: bool
    samples: int
    oldest: int
    newest: int
    rate: float
    authority: str


class EdgeInfo(NamedTuple):
    """The state of the edge between a frame and its parent. All times are in nanoseconds.

    Attributes:
        parent: Parent frame of the newest sample, or "" before any data.
        child: The child frame.
        static: Whether the transform is valid for all time; then the times and rates are 0 and the age is None.
        authority: Publisher of the newest sample.
        samples: Number of samples in the buffer.
        oldest: Stamp of the oldest sample.
        newest: Stamp of the newest sample.
        age: Age of the newest sample; negative if it is ahead of the clock, None if static or without data, and in
            recordings and snapshots if no time was given.
        rate: Samples per second, from the mean interval between the stamps in the buffer.
        jitter: Standard deviation of these intervals.
        longest_gap: The longest of these intervals.
        stored: Number of samples stored since the buffer was created.
        late: Number of stored samples that were older than the newest one at that time.
        repeated: Number of exact duplicates, which have no effect.
        rejected: Number of rejected samples by reason: ``"older than the cache"``, ``"not a number"``,
            ``"invalid quaternion"``, ``"its own parent"``. Reasons that did not occur are omitted.
        stale: Whether the edge is stale: it is not static, and its newest sample is older than 1 s and than 5 times
            the median interval between its stamps. None where the current time is unknown: in recordings, and where the
            stamps are not on the system clock and no `now` was given.
    """

    parent: str
    child: str
    static: bool
    authority: str
    samples: int
    oldest: int
    newest: int
    age: int | None
    rate: float
    jitter: float
    longest_gap: int
    stored: int
    late: int
    repeated: int
    rejected: dict[str, int]
    stale: bool | None


def edge_infos(buffer: Buffer, children: list[str] | None, now: int | None) -> list[EdgeInfo]:
    """Return the state of edges; :meth:`Buffer.edges` describes the arguments."""
    given = now is not None or buffer.frozen or buffer.cache_ns < 0
    wall = system_time.time_ns() if now is None else now
    edges = []
    for facts in buffer._edge_tuples(children):
        newest = facts[0][5]
        present = now if given else current_time_for(newest, wall)
        edges.append(_edge_info(buffer, *facts, None if now is None and given else wall, present))
    return edges


def edge_table(buffer: Buffer) -> str:
    """Return the edges of a buffer as an HTML table."""
    children = [frame.name for frame in buffer.frames() if frame.parent]
    edges = buffer.edges(children[: html_tables.MAX_ROWS])
    rows = [
        (edge.parent, edge.child, edge.samples, "static", "", "", edge.authority)
        if edge.static
        else (
            edge.parent,
            edge.child,
            edge.samples,
            f"{edge.rate:.3g} Hz",
            seconds(edge.oldest),
            seconds(edge.newest),
            edge.authority,
        )
        for edge in edges
    ]
    columns = ("parent", "child", "samples", "rate", "oldest [s]", "newest [s]", "publisher")
    return html_tables.section(repr(buffer), html_tables.table(columns, rows, len(children), "edge"))


_REASONS = ("older than the cache", "its own parent", "not a number", "invalid quaternion")


def _edge_info(
    buffer: Buffer,
    frame: tuple[str, str, bool, int, int, int, float, str],
    intervals: tuple[float, float, float],
    counts: tuple[int, int, int, int, int, int, int],
    now: int | None,
    current_time: int | None,
) -> EdgeInfo:
    child, parent, static, samples, oldest, newest, _, authority = frame
    mean, deviation, longest = intervals
    stored, late, repeated, *refused = counts
    return EdgeInfo(
        parent=parent,
        child=child,
        static=static,
        authority=authority,
        samples=samples,
        oldest=oldest,
        newest=newest,
        age=None if static or not samples or now is None else now - newest,
        rate=time.SECOND / mean if mean else 0.0,
        jitter=deviation,
        longest_gap=round(longest),
        stored=stored,
        late=late,
        repeated=repeated,
        rejected={reason: count for reason, count in zip(_REASONS, refused, strict=True) if count},
        stale=_is_stale(buffer, frame, current_time),
    )


def _is_stale(
    buffer: Buffer, frame: tuple[str, str, bool, int, int, int, float, str], current_time: int | None
) -> bool | None:
    child, parent, static, samples, oldest, newest, *_ = frame
    if static or not samples:
        return False
    if current_time is None:
        return None
    silence = current_time - newest
    # The period is read only if the result depends on it.
    return is_stale(silence, 0.0) and is_stale(silence, buffered_period(buffer, parent, child, oldest, newest, samples))
