# SPDX-License-Identifier: Apache-2.0
"""TrajectoryQuery: a request for the poses of one frame relative to another, for any recording."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from coframe import time
from coframe.bags.namespaces import ALL_TRANSFORMS, TransformChoice
from coframe.bags.time_points import parse_time_point
from coframe.buffer.gaps import SkippedPoses, gap_limit, long_gap_text, skipped_poses
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.bags.recording import Recording
    from coframe.buffer import Buffer
    from coframe.buffer.gaps import OnGap
    from coframe.transform.transform import Transform

__all__ = ["BATCH", "MAX_RATE", "TrajectoryQuery", "sample_stamps", "stamps_at_rate"]

MAX_RATE = 1e6  # Hz
BATCH = 50_000  # poses


@dataclass(frozen=True)
class TrajectoryQuery:
    """Describes which poses of ``source`` relative to ``target`` to look up.

    Attributes:
        target: The frame in which the poses are expressed.
        source: The frame that moves.
        rate: Poses per second (Hz); None: one pose per recorded sample.
        stamps_of: A topic. One pose at the stamp of each of its messages, instead of a rate.
        start: The first stamp: nanoseconds, or a string that :func:`coframe.bags.parse_time_point` parses for each
            recording.
        stop: The last stamp, as nanoseconds or a string.
        transforms: Selects the transforms to read, and the names of their frames.
        max_gap: The maximum interval between two transforms for interpolation: nanoseconds, or a string such as
        ``"200ms"``; None means no limit.
        on_gap: What to do with a pose in a longer gap: ``"omit"`` it, fill it with ``"nan"``, or ``"raise"``.
        validity: Whether the files of :func:`coframe.bags.query_recordings` get the columns of :meth:`validity_of`.

    Raises:
        ValueError: Both ``rate`` and ``stamps_of`` are given, or the rate or ``max_gap`` is out of range.
    """

    target: str
    source: str
    rate: float | None = None
    stamps_of: str | None = None
    start: int | str | None = None
    stop: int | str | None = None
    transforms: TransformChoice = ALL_TRANSFORMS
    max_gap: int | str | None = None
    on_gap: OnGap = "omit"
    validity: bool = False

    def __post_init__(self) -> None:
        if self.rate is not None and self.stamps_of is not None:
            raise ValueError("rate and stamps_of are mutually exclusive: give one of them")
        if self.rate is not None and not 0 < self.rate <= MAX_RATE:
            raise ValueError(f"rate must be above 0 and at most {MAX_RATE:g} Hz, not {self.rate:g}")
        gap_limit(self.max_gap, self.on_gap)

    def run(self, recording: Recording) -> tuple[Transform, int]:
        """Return the poses, at least one, and the number of stamps omitted because there is no transform.

        Raises:
            RecordingError: There are no stamps between ``start`` and ``stop``, or the topic does not exist.
            TransformException: A frame does not exist, or the frames are not connected.
            ValueError: ``start`` or ``stop`` is not a point in time.
        """
        stamps = self.stamps(recording)
        return self._look_up_poses(recording, stamps)

    def stamps(self, recording: Recording) -> NDArray[np.int64]:
        """Return the stamps of the poses, at least one, in order: (N,) nanoseconds.

        Raises:
            RecordingError: As :meth:`run`.
            TransformException: As :meth:`run`.
            ValueError: As :meth:`run`.
        """
        buffer = recording.buffer
        start, stop = _nanoseconds(self.start, recording), _nanoseconds(self.stop, recording)
        if self.stamps_of is not None:
            stamps = np.unique(recording.stamps(self.stamps_of))
            first, last = stamps[:1] if start is None else start, stamps[-1:] if stop is None else stop
            stamps = stamps[(stamps >= first) & (stamps <= last)]
        elif self.rate is not None:
            stamps = stamps_at_rate(buffer.span(self.target, self.source), start, stop, self.rate)
        else:
            stamps = sample_stamps(buffer, self.target, self.source, start, stop)
        if not stamps.size:
            raise _no_stamps_error(recording)
        return stamps

    def batches(self, recording: Recording, stamps: NDArray[np.int64]) -> Iterator[tuple[Transform, int]]:
        """Yield the poses in batches, so that a long trajectory does not have to fit in memory.

        Args:
            recording: The recording whose transforms are looked up.
            stamps: As returned by :meth:`stamps`.

        Yields:
            The poses of a batch (there may be none), and the number of stamps omitted because there is no transform.
        """
        for start in range(0, len(stamps), BATCH):
            yield self._look_up_poses(recording, stamps[start : start + BATCH])

    def gap_text(self, recording: Recording, stamps: NDArray[np.int64]) -> str:
        """Return a message about poses in unusually long gaps, or in those longer than `max_gap`; "" for none."""
        if self.max_gap is None:
            return long_gap_text(recording.buffer, self.target, self.source, stamps)
        return self.skipped_poses(recording, stamps).text

    def skipped_poses(self, recording: Recording, stamps: NDArray[np.int64]) -> SkippedPoses:
        """Return the poses that are omitted or NaN because they lie in gaps longer than `max_gap`."""
        limit = gap_limit(self.max_gap, self.on_gap)
        if limit is None or self.on_gap == "raise":
            return SkippedPoses(0, "")
        return skipped_poses(recording.buffer, self.target, self.source, stamps, limit)

    def validity_of(self, recording: Recording, poses: Transform) -> dict[str, NDArray[np.int64]]:
        """Return how far poses are from the samples that they were computed from. See :meth:`coframe.Buffer.validity`.

        Args:
            recording: The recording from which the poses were computed.
            poses: Poses with stamps, as returned by :meth:`run`.

        Returns:
            ``gap_ns``, the interval that each pose was interpolated over, and ``outside_ns``, how far its time is
            outside of the samples: (N,) nanoseconds each.
        """
        stamps = np.zeros(1, np.int64) if poses.stamps is None else np.atleast_1d(poses.stamps)
        found = recording.buffer.validity(self.target, self.source, stamps)
        return {"gap_ns": found.gaps, "outside_ns": found.outside}

    def _look_up_poses(self, recording: Recording, stamps: NDArray[np.int64]) -> tuple[Transform, int]:
        may_miss = self.rate is not None or self.stamps_of is not None
        poses = recording.buffer.lookup_many(
            self.target,
            self.source,
            stamps,
            on_error="nan" if may_miss else "raise",
            max_gap=self.max_gap,
            on_gap="raise" if self.max_gap is None or self.on_gap == "raise" else "nan",
        )
        found = ~np.isnan(poses.translation[:, 0])
        if self.max_gap is not None and self.on_gap == "nan":
            found |= recording.buffer.validity(self.target, self.source, stamps).outside == 0
        return (poses, 0) if found.all() else (poses[found], int(np.count_nonzero(~found)))


def sample_stamps(buffer: Buffer, target: str, source: str, start: int | None, stop: int | None) -> NDArray[np.int64]:
    """Return the stamps that :meth:`coframe.Buffer.trajectory` uses."""
    span = buffer.span(target, source)
    first = span[0] if start is None else max(span[0], start)
    last = span[1] if stop is None else min(span[1], stop)
    inside = np.frombuffer(buffer._stamps_between(target, source, first, last), dtype=np.int64)
    return np.unique(np.concatenate([[first], inside, [last]]).astype(np.int64)) if first <= last else inside


def _no_stamps_error(recording: Recording) -> RecordingError:
    first, last = (f"{stamp / time.SECOND:.3f} s" for stamp in recording.span)
    return RecordingError(
        "No stamps between the start and the stop of the query.",
        hint=f"The transforms of the recording have stamps from {first} to {last}.",
    )


def _nanoseconds(time_point: int | str | None, recording: Recording) -> int | None:
    return parse_time_point(time_point, recording.span) if isinstance(time_point, str) else time_point


def stamps_at_rate(span: tuple[int, int], start: int | None, stop: int | None, rate: float) -> NDArray[np.int64]:
    """Return times at a rate in Hz that start at the first time of an interval, limited to a time range."""
    first = span[0] if start is None else max(start, span[0])
    last = span[1] if stop is None else min(stop, span[1])
    if last < first:
        return np.empty(0, dtype=np.int64)
    count = int((last - first) * rate / time.SECOND) + 1
    offsets = np.rint(np.arange(count) * (time.SECOND / rate))
    return np.asarray(first + offsets.astype(np.int64))
