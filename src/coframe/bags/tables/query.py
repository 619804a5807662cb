# SPDX-License-Identifier: Apache-2.0
"""TableQuery: a request for a table of fields and poses, for any recording."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe import time
from coframe._output.formatting import count, did_you_mean, duration, join_names
from coframe.bags._trajectory_query import MAX_RATE, stamps_at_rate
from coframe.bags.namespaces import ALL_TRANSFORMS, TransformChoice
from coframe.bags.tables._covariances import load_covariances
from coframe.bags.tables._sampling import FieldColumn, PoseColumn, TopicReader, outside_text, path_column
from coframe.bags.tables.columns import METHODS, Column, FieldSource, PathSource, PoseSource, column, column_list
from coframe.bags.tables.table import Table
from coframe.bags.time_points import parse_time_point
from coframe.buffer.gaps import gap_limit
from coframe.errors import ExtrapolationException, RecordingError
from coframe.trajectories import read_trajectory
from coframe.transform.values import stamps_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import ArrayLike, NDArray

    from coframe.bags.recording import Recording
    from coframe.bags.tables.columns import ColumnLike, Method
    from coframe.bags.tables.table import TableColumn
    from coframe.buffer.gaps import OnGap
    from coframe.time import DurationLike, StampLike
    from coframe.transform.transform import Transform

__all__ = ["MAX_BATCH_BYTES", "MAX_BATCH_ROWS", "MAX_ROWS", "TableQuery"]

MAX_ROWS = 100_000_000
MAX_BATCH_ROWS = 20_000
MAX_BATCH_BYTES = 64 << 20  # of the messages of one batch


@dataclass(frozen=True)
class TableQuery:
    """Description of a table of message fields and frame poses for :meth:`Recording.table`. It can be pickled.

    Attributes:
        columns: The columns, or one.
        at: The topic at whose stamps the rows are. None: if all columns come from one topic, this one.
        rate: Rows per second (Hz) in the interval in which all columns have values, instead of ``at``.
        start: The first time: nanoseconds, or a string that :func:`coframe.bags.parse_time_point` parses.
        stop: The last time.
        method: The method of columns that have none.
        tolerance: The maximum time between a row and a message.
        max_gap: The maximum interval for interpolation, between two messages or two transforms.
        on_gap: What to do with a row in which a value is missing: mark it with ``"nan"``, ``"omit"`` the row, or
            ``"raise"``.
        covariance: Whether poses have the value ``covariance``, row by row in ROS's order.
        validity: Whether the table contains the validity of its columns.
        transforms: Selects the transforms to read, and the names of their frames.

    Raises:
        RecordingError: A column is not valid, or options contradict each other.
        ValueError: A limit is out of range.
    """

    columns: ColumnLike | Sequence[ColumnLike]
    at: str | None = None
    rate: float | None = None
    start: StampLike | str | None = None
    stop: StampLike | str | None = None
    method: Method = "nearest"
    tolerance: DurationLike | None = None
    max_gap: DurationLike | None = None
    on_gap: OnGap = "nan"
    covariance: bool = False
    validity: bool = True
    transforms: TransformChoice = ALL_TRANSFORMS

    def __post_init__(self) -> None:
        object.__setattr__(self, "columns", tuple(map(column, column_list(self.columns))))
        if not self.columns:
            raise RecordingError("a table needs at least one column", hint="Such as '/odom.pose' or ('map', 'camera').")
        if self.at is not None and self.rate is not None:
            raise RecordingError("at and rate are mutually exclusive: give one of them")
        if self.rate is not None and not 0 < self.rate <= MAX_RATE:
            raise RecordingError(f"rate must be above 0 and at most {MAX_RATE:g} Hz, not {self.rate:g}")
        if self.method not in METHODS:
            hint = f"{did_you_mean(str(self.method), METHODS)} Methods: {', '.join(METHODS)}.".lstrip()
            raise RecordingError(f"no method named {self.method!r}", hint=hint)
        if self.tolerance is not None and time.duration_ns(self.tolerance) < 0:
            raise RecordingError(f"tolerance must not be negative, not {self.tolerance!r}")
        gap_limit(self.max_gap, self.on_gap)

    def run(
        self, recording: Recording, stamps: ArrayLike | None = None, *, report: Callable[[str], object] | None = None
    ) -> Table:
        """Return the table.

        Args:
            recording: The recording with the messages and transforms.
            stamps: The times of the rows, (N,) nanoseconds or datetime64, instead of ``at`` and ``rate``.
            report: Called with a sentence for values that are less certain than usual; None ignores them.

        Raises:
            RecordingError: A topic or field does not exist, or a column has no values.
            TransformException: A frame does not exist, or the frames are not connected.
            ExtrapolationException: A value is missing, with ``on_gap="raise"``.
        """
        return Table.joined(list(self.batches(recording, stamps, report=report)))

    def batches(
        self, recording: Recording, stamps: ArrayLike | None = None, *, report: Callable[[str], object] | None = None
    ) -> Iterator[Table]:
        """Yield the table in parts of limited size, at least one, so that a long one does not have to fit in memory.

        Args:
            recording: As in :meth:`run`.
            stamps: As in :meth:`run`.
            report: As in :meth:`run`.

        Raises:
            RecordingError: As in :meth:`run`; for columns without any value, at the end.
            TransformException: As in :meth:`run`.
            ExtrapolationException: As in :meth:`run`.
        """
        evaluation = _Evaluation(self, recording, stamps, report or (lambda _sentence: None))
        yield from evaluation.batches()


class _Evaluation:
    """One run of a query on a recording."""

    def __init__(
        self, query: TableQuery, recording: Recording, stamps: ArrayLike | None, report: Callable[[str], object]
    ) -> None:
        self._query, self._recording, self._report = query, recording, report
        self._topics: dict[str, TopicReader] = {}
        parsed = [column(each) for each in column_list(query.columns)]
        self._reference_topic = None if stamps is not None else self._at_topic(parsed)
        if query.covariance:
            load_covariances(recording, [each.parsed for each in parsed if isinstance(each.parsed, PoseSource)])
        self._columns = [self._new_column(each) for each in parsed]
        names = [each.label for each in self._columns]
        if twice := [name for name in names if names.count(name) > 1]:
            raise RecordingError(
                f"two columns of the table are named {twice[0]!r}",
                hint='Give one of them a name: Column(source, name="other"), or "other=SOURCE".',
            )
        self._rows: NDArray[np.intp] | None = None
        self._times = self._all_times(stamps)

    def batches(self) -> Iterator[Table]:
        """Yield the parts of the table."""
        has_values = np.zeros(len(self._columns), dtype=bool)
        step = self._batch_rows()
        for start in range(0, len(self._times), step):
            part = slice(start, start + step)
            table = self._part(self._times[part], None if self._rows is None else self._rows[part])
            has_values |= [bool(each.valid.any()) for each in table.columns]
            yield self._apply_gap_policy(table)
        for each, has_value in zip(self._columns, has_values, strict=True):
            if not has_value:
                hint = self._missing_hint(each)
                raise RecordingError(outside_text(each.label, each.span, self._times), hint=hint)
        sentences = [each.note() for each in self._columns] + [
            f"{topic}: {count(reader.damaged, 'message')} cannot be decoded; their values are missing"
            for topic, reader in self._topics.items()
            if reader.damaged
        ]
        for sentence in filter(None, sentences):
            self._report(sentence)

    # The rows.

    def _at_topic(self, columns: list[Column]) -> str | None:
        """Return the topic at whose stamps the rows are, or None for a rate."""
        if self._query.at is not None:
            return self._topic(self._query.at).topic
        if self._query.rate is not None:
            return None
        topics = {each.parsed.topic for each in columns if isinstance(each.parsed, FieldSource)}
        if len(topics) == 1:
            return self._topic(topics.pop()).topic
        which = f"the columns come from {join_names(sorted(topics))}" if topics else "poses have no stamps of their own"
        raise RecordingError(
            f"the rows of the table have no times: {which}",
            hint='Give a topic, such as at="/camera/image", or rate=10.',
        )

    def _all_times(self, given: ArrayLike | None) -> NDArray[np.int64]:
        start, stop = (self._nanoseconds(when) for when in (self._query.start, self._query.stop))
        if self._query.rate is not None and given is None:
            times = self._times_at_rate(self._query.rate, start, stop)
        else:
            times = (
                self._topics[self._reference_topic].samples
                if self._reference_topic is not None
                else np.sort(np.ravel(stamps_of(given)))
            )
        inside = np.ones(len(times), dtype=bool)
        inside &= True if start is None else times >= start
        inside &= True if stop is None else times <= stop
        if not inside.any():
            first, last = (
                (f"{stamp / time.SECOND:.3f} s" for stamp in (times.min(), times.max())) if len(times) else ("", "")
            )
            there = f"The rows without start and stop are from {first} to {last}." if first else ""
            raise RecordingError("the table has no rows between start and stop", hint=there)
        if self._reference_topic is not None:
            self._rows = np.flatnonzero(inside)
        return times[inside]

    def _times_at_rate(self, rate: float, start: int | None, stop: int | None) -> NDArray[np.int64]:
        spans = [(each.label, each.span) for each in self._columns if each.span is not None]
        if not spans:
            spans = [("the recording", self._recording.span)]
        latest = max(spans, key=lambda each: each[1][0])
        earliest = min(spans, key=lambda each: each[1][1])
        common = (latest[1][0], earliest[1][1])
        if common[0] > common[1]:
            raise RecordingError(
                f"no time has values of all columns: {latest[0]} begins {duration(common[0] - common[1])} after "
                f"{earliest[0]} ends",
                hint="Their stamps may be on different clocks; give the rows with at=.",
            )
        length = min(common[1], common[1] if stop is None else stop) - max(
            common[0], common[0] if start is None else start
        )
        if length * rate / time.SECOND > MAX_ROWS:
            raise RecordingError(f"{rate:g} rows per second over {duration(length)} are more than {MAX_ROWS} rows")
        return stamps_at_rate(common, start, stop, rate)

    def _nanoseconds(self, time_point: StampLike | str | None) -> int | None:
        if time_point is None:
            return None
        return (
            parse_time_point(time_point, self._recording.span)
            if isinstance(time_point, str)
            else time.stamp_ns(time_point)
        )

    def _batch_rows(self) -> int:
        """Return how many rows a batch has: few if their messages are large."""
        sizes = [reader.message_bytes for topic, reader in self._topics.items() if topic in self._large_topics()]
        return max(1, min(MAX_BATCH_ROWS, MAX_BATCH_BYTES // max([1, *sizes])))

    def _large_topics(self) -> set[str]:
        """Return the topics of columns whose values have no fixed size."""
        kinds = {"bytes", "numbers", "list", "text"}
        fields = [each for each in self._columns if isinstance(each, FieldColumn)]
        return {each.messages.topic for each in fields if any(leaf.kind in kinds for leaf in each.leaves)}

    # The columns.

    def _topic(self, name: str) -> TopicReader:
        found = self._recording.find_topic(name)
        if found not in self._topics:
            self._topics[found] = TopicReader(self._recording, found)
            if not self._recording.has_stamps(found):
                self._report(f"{found}: the messages have no stamp, so their receive times are used")
        return self._topics[found]

    def _new_column(self, requested: Column) -> FieldColumn | PoseColumn:
        query = self._query
        max_gap = requested.max_gap if requested.max_gap is not None else query.max_gap
        limit = None if max_gap is None else time.duration_ns(max_gap)
        source = requested.parsed
        if isinstance(source, PathSource):
            poses = self._read_path(source.poses) if isinstance(source.poses, str) else source.poses
            return path_column(requested.label, poses, limit, covariance=query.covariance)
        if isinstance(source, PoseSource):
            return PoseColumn(requested.label, source, self._recording.buffer, limit, covariance=query.covariance)
        tolerance = requested.tolerance if requested.tolerance is not None else query.tolerance
        return FieldColumn(
            requested.label,
            source,
            self._topic(source.topic),
            requested.method or query.method,
            None if tolerance is None else time.duration_ns(tolerance),
            limit,
        )

    def _read_path(self, file: str) -> Transform:
        return read_trajectory(file, report=self._report)

    def _part(self, times: NDArray[np.int64], rows: NDArray[np.intp] | None) -> Table:
        """Return the table at some times, with the numbers of their messages if they are the stamps of a topic."""
        found: dict[str, TableColumn] = {}
        for messages in self._topics.values():
            columns = [each for each in self._columns if isinstance(each, FieldColumn) and each.messages is messages]
            found |= _read_together(messages, columns, times, rows if messages.topic == self._reference_topic else None)
        poses = {each.label: each.values(times) for each in self._columns if isinstance(each, PoseColumn)}
        found |= poses
        return Table(times, [found[each.label] for each in self._columns], self._query.validity)

    def _apply_gap_policy(self, table: Table) -> Table:
        """Return the table without rows that are to be omitted, or raise for the first row with a missing value."""
        if self._query.on_gap == "nan":
            return table
        complete = np.logical_and.reduce([each.valid for each in table.columns])
        if self._query.on_gap == "raise" and not complete.all():
            row = int(np.argmin(complete))
            missing = next(each for each in table.columns if not each.valid[row])
            raise ExtrapolationException.with_details(
                f"{missing.name} has no value at {int(table.stamps[row])} ns within the limits "
                f"({count(int((~complete).sum()), 'such row')})",
                target="",
                source="",
                requested=int(table.stamps[row]),
                hint='on_gap="nan" marks such values; on_gap="omit" omits their rows.',
            )
        kept = table.taken(complete)
        return replace(kept, omitted=int((~complete).sum()))

    def _missing_hint(self, missing: FieldColumn | PoseColumn) -> str:
        if missing.span is not None:
            first, last = missing.span
            if first <= int(self._times.max()) and int(self._times.min()) <= last:
                if isinstance(missing, PoseColumn):
                    return "Its transforms are too far apart: increase max_gap."
                return "Increase tolerance or max_gap, or choose another method."
        return "Their stamps may be on different clocks."


def _read_together(
    messages: TopicReader, columns: list[FieldColumn], times: NDArray[np.int64], rows: NDArray[np.intp] | None
) -> dict[str, TableColumn]:
    """Return all columns of one topic. Each message is decoded once."""
    picks = [each.picks(times, rows) for each in columns]
    row_numbers = [np.unique(np.concatenate([each.first, each.second])) for each in picks]
    values: list[list[Any]] = [[None] * len(indices) for indices in row_numbers]
    every = np.unique(np.concatenate(row_numbers)) if row_numbers else np.empty(0, np.intp)
    slots = [np.searchsorted(indices, every) for indices in row_numbers]
    needed = [np.isin(every, indices) for indices in row_numbers]
    place = {int(index): number for number, index in enumerate(every)}
    for index, message in messages.iterate_messages(place):
        number = place[index]
        for column_number, each in enumerate(columns):
            if needed[column_number][number]:
                values[column_number][slots[column_number][number]] = each.read(message)
    return {
        each.label: each.values(chosen, read, indices)
        for each, chosen, read, indices in zip(columns, picks, values, row_numbers, strict=True)
    }
