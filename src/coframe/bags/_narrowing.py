# SPDX-License-Identifier: Apache-2.0
"""Read only a part of a recording on a server for a table that needs no more."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

import numpy as np

from coframe import time
from coframe.bags._time_window import TimeWindow
from coframe.bags.tables.columns import FieldSource, column, column_list
from coframe.bags.time_points import parse_time_point
from coframe.bags.transforms import is_static
from coframe.errors import CoframeError
from coframe.transform.values import stamps_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike

    from coframe.bags.recording import Recording
    from coframe.bags.tables import Table, TableColumn, TableQuery
    from coframe.time import StampLike

__all__ = ["run_query"]

# Messages are searched by their receive times, but rows have stamps. If all stamps in a part are at most this far from
# their receive times, no message outside of the margin has a stamp inside.
MAX_DELAY: Final = 5 * time.SECOND
MARGIN: Final = 10 * time.SECOND


def run_query(
    recording: Recording, query: TableQuery, stamps: ArrayLike | None, report: Callable[[str], object]
) -> Table:
    """Return a table. If this gives the same rows, only a part of a recording on a server is read.

    For such a recording, a start and a stop that are strings count from the receive times.

    Args:
        recording: The recording.
        query: The table.
        stamps: The times of the rows, or None if the query has them.
        report: Called with a sentence for values that are less certain than usual.

    Raises:
        RecordingError: As :meth:`TableQuery.run`.
        TransformException: As :meth:`TableQuery.run`.
    """
    if recording.is_waiting:
        query = replace(query, start=_nanoseconds(query.start, recording), stop=_nanoseconds(query.stop, recording))
        sentences: list[str] = []
        table = _from_part(recording, query, stamps, sentences.append)
        if table is not None:
            for sentence in sentences:
                report(sentence)
            return table
    return query.run(recording, stamps, report=report)


def _from_part(
    recording: Recording, query: TableQuery, stamps: ArrayLike | None, report: Callable[[str], object]
) -> Table | None:
    """Return the table of a part of a recording, or None if the full table may have other values."""
    first, last = (_nanoseconds(when, recording) for when in (query.start, query.stop))
    if stamps is not None and np.size(given := stamps_of(stamps)):
        first = int(np.min(given)) if first is None else first
        last = int(np.max(given)) if last is None else last
    if first is None and last is None:
        return None
    window = TimeWindow(None if first is None else first - MARGIN, None if last is None else last + MARGIN + 1)
    try:
        part = recording.part(window)
        table = query.run(part, stamps, report=report) if _is_prompt(part, query) else None
    except (CoframeError, ValueError):  # The whole recording may have what is missing here.
        return None
    return None if table is None or any(map(_may_differ, table.columns)) else table


def _may_differ(column: TableColumn) -> bool:
    """Return whether a message or a transform outside of the part may be nearer to a row."""
    is_far = column.age is not None and bool((np.abs(column.age[column.valid]) > MARGIN - MAX_DELAY).any())
    return is_far or not column.valid.all()


def _nanoseconds(time_point: StampLike | str | None, recording: Recording) -> int | None:
    if isinstance(time_point, str):
        return parse_time_point(time_point, (recording.received_start, recording.received_end))
    return None if time_point is None else time.stamp_ns(time_point)


def _is_prompt(part: Recording, query: TableQuery) -> bool:
    """Return whether the messages of a part were received soon after their stamps."""
    parsed = [each.parsed for each in map(column, column_list(query.columns))]
    names = {each.topic for each in parsed if isinstance(each, FieldSource)} | ({query.at} if query.at else set())
    topics = [topic for topic in part.topics if topic.removeprefix("/") in {each.removeprefix("/") for each in names}]
    if len(topics) != len({each.removeprefix("/") for each in names}) or not all(
        len(part.received(topic)) for topic in topics
    ):
        return False
    delays = [np.abs(part.stamps(topic) - part.received(topic)).max(initial=0) for topic in topics]
    spans = [
        (edge.oldest - part.received_start, edge.newest - part.received_end)
        for edge in part.buffer.edges()
        if edge.samples and not edge.static and not is_static(edge.authority)
    ]
    limit = MARGIN + MAX_DELAY  # Transforms are read from before the part, and until after it.
    is_late = any(abs(early) > limit + MARGIN or abs(late) > limit + MARGIN for early, late in spans)
    return bool(topics or spans) and max(delays, default=0) <= MAX_DELAY and not is_late
