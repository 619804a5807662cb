# SPDX-License-Identifier: Apache-2.0
"""The columns of a table at some times: fields of messages, and poses of frames."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from coframe._output.formatting import count, did_you_mean, duration, join_names, seconds
from coframe.analysis.liveness import usual_gap, usual_period
from coframe.bags.tables._fields import FieldReader
from coframe.bags.tables._leaves import Leaf
from coframe.bags.tables._matching import MatchedRows, pick
from coframe.bags.tables._values import check_interpolation, values_at
from coframe.bags.tables.columns import Key, PoseSource
from coframe.bags.tables.table import TableColumn, TableValue
from coframe.buffer import Buffer
from coframe.buffer.gaps import long_gap_text
from coframe.errors import DecodeError, RecordingError, TransformException
from coframe.trajectories.formats import POSE_COLUMNS
from coframe.transform.quantities import POSE_QUANTITIES, coordinate
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from coframe.bags.recording import Recording
    from coframe.bags.tables.columns import FieldSource, Method

__all__ = ["FieldColumn", "PoseColumn", "SampledColumn", "TopicReader", "outside_text", "path_column"]

MAX_ELEMENT_NAMES = 1000  # of one topic
_MIN_INTERVALS = 10  # With fewer messages, the usual period of a topic is not known.
_COVARIANCE = Leaf(("covariance",), "array", np.dtype("float64"), 36)


class SampledColumn(Protocol):
    """A column that has values in an interval of time."""

    label: str

    @property
    def span(self) -> tuple[int, int] | None:
        """The first and the last time with a value, in nanoseconds, or None if it has one at any time."""

    def note(self) -> str:
        """Return a sentence about values that are less certain than usual, or "" if there are none."""


class TopicReader:
    """Reads messages of a topic by their stamps.

    Attributes:
        topic: The name of the topic.
        samples: The stamps of the messages, sorted, (M,) nanoseconds.
        damaged: Number of messages that could not be decoded.
    """

    def __init__(self, recording: Recording, topic: str) -> None:
        self._recording = recording
        self.topic = topic
        stamps = recording.stamps(topic)
        if not stamps.size:
            raise RecordingError(
                f"{topic} has no messages in {recording.path}", hint="`coframe bag info` lists the topics."
            )
        self._order = np.argsort(stamps, kind="stable")
        self.samples = stamps[self._order]
        self._decoded_rows: set[int] = set()
        self._damaged_rows: set[int] = set()

    @property
    def damaged(self) -> int:
        """Number of messages that could not be decoded."""
        return len(self._damaged_rows)

    @property
    def message_bytes(self) -> int:
        """Size of a message in the middle of the recording, in bytes."""
        found = self._recording.message_in_row(self.topic, len(self.samples) // 2)
        return 0 if found is None else len(found.data)

    def first(self) -> Any:
        """Return the first message that can be decoded.

        Raises:
            RecordingError: There is none.
        """
        for index in range(len(self.samples)):
            message = self._message(index)
            if message is not None:
                return message
        raise RecordingError(f"{self.topic}: no message can be decoded", hint="The bytes are damaged.")

    def iterate_messages(self, indices: Iterable[int]) -> Iterable[tuple[int, Any]]:
        """Yield some messages with their index in `samples`, in the order of the file, or None if damaged."""
        by_row = sorted((int(self._order[index]), index) for index in indices)
        return ((index, self._message(index)) for _, index in by_row)

    def _message(self, index: int) -> Any:
        found = self._recording.message_in_row(self.topic, int(self._order[index]))
        try:
            return None if found is None else found.message
        except DecodeError:
            self._damaged_rows.add(index)
            return None


class FieldColumn:
    """A column with a field of the messages on a topic.

    Attributes:
        label: The name of the column.
        messages: The messages of its topic.
        limited: Whether the distance to the messages has a limit.
    """

    def __init__(
        self,
        label: str,
        source: FieldSource,
        messages: TopicReader,
        method: Method,
        tolerance: int | None,
        max_gap: int | None,
    ) -> None:
        self.label = label
        self.messages = messages
        self._source = source
        self._method: Method = method
        self._tolerance, self._max_gap = tolerance, max_gap
        first = messages.first()
        reader = FieldReader(label, source, first)
        names: dict[tuple[str, ...], list[str]] = {}
        self._chosen_rows = np.arange(len(messages.samples))  # the messages that have the element
        if reader.name_lists or reader.has_elements:
            names, self._chosen_rows = self._scan(reader)
        self._readers = {type(first): FieldReader(label, source, first, names)}
        self._names = names
        self.leaves = self._readers[type(first)].leaves
        if method == "interpolate":
            check_interpolation(label, self.leaves)
        self._unusual_count, self._longest_gap, self._rows = 0, 0, 0

    @property
    def samples(self) -> NDArray[np.int64]:
        """The stamps of the messages that have the element, sorted."""
        return self.messages.samples[self._chosen_rows]

    @property
    def span(self) -> tuple[int, int] | None:
        """The first and the last stamp of its messages."""
        samples = self.samples
        return int(samples[0]), int(samples[-1])

    def picks(self, times: NDArray[np.int64], rows: NDArray[np.intp] | None) -> MatchedRows:
        """Return the messages for some times, as indices into the messages of the topic.

        Args:
            times: (N,) nanoseconds.
            rows: The messages at these times, if these are the stamps of its topic.
        """
        every = len(self._chosen_rows) == len(self.messages.samples)
        if rows is not None and every and self._method != "interpolate":
            zero = np.zeros(len(times), np.int64)
            return MatchedRows(rows, rows, np.zeros(len(times)), np.ones(len(times), bool), zero, zero)
        found = pick(self.samples, times, self._method, self._tolerance, self._max_gap)
        self._count_unusual(found)
        return found._replace(first=self._chosen_rows[found.first], second=self._chosen_rows[found.second])

    def values(self, picks: MatchedRows, messages: Sequence[Any], indices: NDArray[np.intp]) -> TableColumn:
        """Return the column.

        Args:
            picks: As returned by :meth:`picks`.
            messages: What :meth:`read` returned for each of `indices`.
            indices: The messages, sorted.
        """
        here = picks._replace(
            first=np.searchsorted(indices, picks.first), second=np.searchsorted(indices, picks.second)
        )
        interpolate = self._method == "interpolate"
        arrays, known = values_at(self.leaves, messages, here, interpolate=interpolate)
        values = [TableValue(*each) for each in zip(self.leaves, map(_fill_unknown, arrays, known), known, strict=True)]
        valid = picks.valid.copy()
        if known:
            valid &= np.logical_or.reduce(known)
        return TableColumn(
            self.label, values, valid, None if interpolate else picks.age, picks.gap if interpolate else None
        )

    def read(self, message: Any) -> tuple[Any, ...] | None:
        """Return the values of a message, one for each leaf."""
        if message is None:
            return None
        if type(message) not in self._readers:  # The type of the topic has another definition in another file.
            reader = FieldReader(self.label, self._source, message, self._names)
            self._readers[type(message)] = reader
        reader = self._readers[type(message)]
        found = reader.read(message)
        if found is None or reader.leaves == self.leaves:
            return found
        by_steps = {leaf.steps: value for leaf, value in zip(reader.leaves, found, strict=True)}
        return tuple(by_steps.get(leaf.steps) for leaf in self.leaves)

    def note(self) -> str:
        """Return a sentence about values in unusually long gaps between messages, or "" if there are none."""
        if not self._unusual_count:
            return ""
        how = "are interpolated over gaps of up to" if self._method == "interpolate" else "come from messages up to"
        away = "" if self._method == "interpolate" else " away"
        covered = f"{self._unusual_count} of {count(self._rows, 'value')} of {self.label}"
        return f"{covered} {how} {duration(self._longest_gap)}{away}"

    def _count_unusual(self, picks: MatchedRows) -> None:
        limit = self._max_gap if self._method == "interpolate" else self._tolerance
        self._rows += len(picks.valid)
        if limit is not None or self._method == "match" or len(self.samples) <= _MIN_INTERVALS:
            return
        distance = np.where(picks.valid, picks.gap if self._method == "interpolate" else np.abs(picks.age), 0)
        usual = usual_gap(usual_period(self.samples))
        self._unusual_count += int((distance > usual).sum())
        self._longest_gap = max(self._longest_gap, int(distance.max(initial=0)))

    def _scan(self, reader: FieldReader) -> tuple[dict[tuple[str, ...], list[str]], NDArray[np.intp]]:
        """Return the names of elements in all messages, and the messages that have the element of the path."""
        names: dict[tuple[str, ...], dict[str, None]] = {path: {} for path in reader.name_lists}
        has_value = np.zeros(len(self.messages.samples), dtype=bool)
        others: dict[str, None] = {}
        for index, message in self.messages.iterate_messages(range(len(self.messages.samples))):
            if message is None:
                continue
            found = reader.read(message)
            has_value[index] = found is not None and (
                bool(reader.name_lists) or any(each is not None for each in found)
            )
            for path, elements in zip(reader.name_lists, reader.element_names(message), strict=True):
                names[path].update(dict.fromkeys(elements))
                if len(names[path]) > MAX_ELEMENT_NAMES:
                    raise RecordingError(
                        f"{self.label}: the messages name more than {MAX_ELEMENT_NAMES} elements",
                        hint="Choose one: /topic.field[name].",
                    )
            if not has_value[index]:
                others.update(dict.fromkeys(reader.names_beside(message)))
        if not has_value.any():
            keys = [step for step in self._source.path if isinstance(step, Key)]
            known = f"{did_you_mean(keys[0], others)} Names: {join_names(others)}.".strip() if keys and others else ""
            raise RecordingError(f"{self.label}: no message has this element", hint=known)
        return {path: list(found) for path, found in names.items()}, np.flatnonzero(has_value)


class PoseColumn:
    """A column with the pose of a frame, or with one of its quantities.

    Raises:
        TransformException: A frame does not exist, or the frames are not connected.
    """

    def __init__(
        self, label: str, source: PoseSource, buffer: Buffer, max_gap: int | None, *, covariance: bool
    ) -> None:
        self.label = label
        self._buffer = buffer
        self._max_gap = max_gap
        self._covariance = covariance
        self._target, self._source, self._quantity = source.target, source.source, ""
        name, dot, quantity = source.source.rpartition(".")
        if source.is_text and dot and quantity in POSE_QUANTITIES:
            known = set(buffer.frame_names())
            if source.source not in known:
                self._source, self._quantity = name, quantity
        self._target, self._source = (frame.removeprefix("/") or frame for frame in (self._target, self._source))
        first, last = self._buffer.span(self._target, self._source)
        self.span = None if first == last == 0 else (first, last)
        self._times: list[NDArray[np.int64]] = []
        self._has_covariance = False

    def values(self, times: NDArray[np.int64]) -> TableColumn:
        """Return the column at some times."""
        rows, covariances = np.full((len(times), 7), np.nan), np.full((len(times), 36), np.nan)
        inside = np.ones(len(times), dtype=bool)
        if self.span is not None:
            inside = (times >= self.span[0]) & (times <= self.span[1]) & (times != 0)
        gaps = np.zeros(len(times), dtype=np.int64)
        if inside.any():
            gaps[inside] = self._buffer.validity(self._target, self._source, times[inside]).gaps
            if self._max_gap is not None:
                inside &= gaps <= self._max_gap
        if inside.any():
            rows[inside], covariances[inside] = self._looked_up(times[inside])
        self._times.append(times[inside])
        valid = ~np.isnan(rows[:, 0])
        return TableColumn(self.label, self._values(rows, covariances, valid), valid, gap=gaps)

    def note(self) -> str:
        """Return a sentence about poses in unusually long gaps, and about covariances, or "" if there is nothing."""
        times = np.concatenate(self._times) if self._times else np.empty(0, np.int64)
        text = "" if self._max_gap is not None else long_gap_text(self._buffer, self._target, self._source, times)
        if self._covariance and not self._has_covariance:
            zero = f"no pose of {self.label} has a covariance, so its covariances are 0"
            return f"{text}; {zero}" if text else zero
        return text

    def _looked_up(self, times: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        nothing = np.full((len(times), 7), np.nan), np.full((len(times), 36), np.nan)
        try:
            poses = self._buffer.lookup_many(
                self._target, self._source, times, on_error="nan", covariance=self._covariance
            )
        except TransformException:  # The frames are connected at other times only.
            return nothing
        covariances = nothing[1]
        if poses.covariance is not None:
            covariances = poses.covariance.reshape(-1, 36)
            self._has_covariance |= bool(np.nan_to_num(covariances).any())
        return np.asarray(poses), covariances

    def _values(
        self, rows: NDArray[np.float64], covariances: NDArray[np.float64], valid: NDArray[np.bool_]
    ) -> list[TableValue]:
        number = np.dtype("float64")
        if self._quantity:
            value = np.full(len(rows), np.nan)
            if valid.any():
                value[valid] = coordinate(Transform(rows[valid, :3], rows[valid, 3:]), self._quantity)
            return [TableValue(Leaf((), "number", number), value, valid)]
        values = [
            TableValue(Leaf((name,), "number", number, axis=name[1:] if name.startswith("q") else ""), array, valid)
            for name, array in zip(POSE_COLUMNS, np.ascontiguousarray(rows.T), strict=True)
        ]
        return [*values, TableValue(_COVARIANCE, covariances, valid)] if self._covariance else values


def path_column(label: str, poses: Transform, max_gap: int | None, *, covariance: bool) -> PoseColumn:
    """Return a column with the poses of a trajectory.

    Raises:
        RecordingError: It has no stamps.
    """
    if poses.stamps is None or len(poses.shape) != 1 or not len(poses):
        raise RecordingError(
            f"{label} has no stamps, so it has no poses at the times of the rows",
            hint="Give a trajectory with stamps: a batch of shape (N,), or a file such as TUM or EuRoC.",
        )
    buffer = Buffer(None)
    order = np.argsort(poses.stamps, kind="stable")
    plain = poses[order].replace(target=None, source=None)
    buffer.set_many("reference", "pose", None, plain)
    return PoseColumn(label, PoseSource("reference", "pose"), buffer, max_gap, covariance=covariance)


def _fill_unknown(array: NDArray[Any], known: NDArray[np.bool_]) -> NDArray[Any]:
    """Return the values with those that are not known as NaN, None or 0."""
    if known.all():
        return array
    marked: NDArray[Any] = array.copy()
    marked[~known] = np.nan if array.dtype.kind == "f" else None if array.dtype.kind == "O" else 0
    return marked


def outside_text(label: str, span: tuple[int, int] | None, times: NDArray[np.int64]) -> str:
    """Return why a column has no value at any time."""
    there = "" if span is None else f": it has values from {seconds(span[0])} to {seconds(span[1])} s"
    rows = f"the rows are from {seconds(int(times.min()))} to {seconds(int(times.max()))} s"
    return f"{label} has no value at any row{there}, and {rows}"
