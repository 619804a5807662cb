"""A question to a recording that can be asked of many: where did this frame go, seen from that one?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from coframe import time
from coframe.bags.instants import parse_instant
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.bags.recording import Recording
    from coframe.transform import Transform

__all__ = ["FASTEST", "Question"]

FASTEST = 1e6  # Hz
_NOTHING = ("there is nothing between these times", "See `coframe bag info` for what there is.")


@dataclass(frozen=True)
class Question:
    """Where ``source`` went, seen from ``target``.

    Attributes:
        target: The frame the poses are told in.
        source: The frame that moves.
        rate: So many poses a second; None: at the samples' own times.
        stamps_of: At the stamps of this topic's messages instead.
        start: From when on: nanoseconds, or text as :func:`coframe.bags.parse_instant` reads it for each recording.
        stop: Until when.
        namespace: As of :func:`coframe.open_bag`, like the three that follow.
        tf_topics: Only their transforms.
        prefix: Goes in front of the names of frames.
        keep: Frames without it.

    Raises:
        ValueError: Both ``rate`` and ``stamps_of``, or a rate that is none.
    """

    target: str
    source: str
    rate: float | None = None
    stamps_of: str | None = None
    start: int | str | None = None
    stop: int | str | None = None
    namespace: str | None = None
    tf_topics: tuple[str, ...] | None = None
    prefix: str = ""
    keep: str = ""

    def __post_init__(self) -> None:
        if self.rate is not None and self.stamps_of is not None:
            raise ValueError("rate and stamps_of exclude each other")
        if self.rate is not None and not 0 < self.rate <= FASTEST:
            raise ValueError(f"rate must be above 0 and at most {FASTEST:g} Hz, not {self.rate:g}")

    def ask(self, recording: Recording) -> tuple[Transform, int]:
        """The poses there are, one at least, and how many times were left out because there is no transform.

        Raises:
            RecordingError: There is nothing between those times, or no such topic.
            TransformException: The frames are not there or not connected.
            ValueError: ``start`` or ``stop`` is no time.
        """
        buffer = recording.buffer
        start, stop = _instant(self.start, recording), _instant(self.stop, recording)
        if self.rate is None and self.stamps_of is None:
            poses = buffer.trajectory(self.target, self.source, start, stop)
            if not len(poses):
                raise RecordingError(_NOTHING[0], hint=_NOTHING[1])
            return poses, 0
        if self.stamps_of is not None:
            stamps = np.unique(recording.stamps(self.stamps_of))
            first, last = stamps[:1] if start is None else start, stamps[-1:] if stop is None else stop
            stamps = stamps[(stamps >= first) & (stamps <= last)]
        else:
            stamps = _at_rate(buffer.span(self.target, self.source), start, stop, self.rate or 1.0)
        if not stamps.size:
            raise RecordingError(_NOTHING[0], hint=_NOTHING[1])
        poses = buffer.lookup_many(self.target, self.source, stamps, on_error="nan")
        there = ~np.isnan(poses.translation[:, 0])
        return poses[there], int(np.count_nonzero(~there))


def _instant(when: int | str | None, recording: Recording) -> int | None:
    return parse_instant(when, recording.span) if isinstance(when, str) else when


def _at_rate(span: tuple[int, int], start: int | None, stop: int | None, rate: float) -> NDArray[np.int64]:
    first = span[0] if start is None else max(start, span[0])
    last = span[1] if stop is None else min(stop, span[1])
    if last < first:
        return np.empty(0, dtype=np.int64)
    count = int((last - first) * rate / time.SECOND) + 1
    offsets = np.rint(np.arange(count) * (time.SECOND / rate))
    return np.asarray(first + offsets.astype(np.int64))
