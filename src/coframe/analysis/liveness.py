# SPDX-License-Identifier: Apache-2.0
"""Rules for gaps and stale edges, and a tracker that applies them to a buffer.

All parts of coframe use this module: the doctor, the drawings, ``monitor``, ``why``, the terminal screens, the viewer,
:meth:`coframe.Buffer.edges` and the publishers and relays of transforms.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, overload

import coframe.lazy_numpy as np
from coframe.time import MILLISECOND, SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from coframe.buffer import Buffer, FrameInfo

__all__ = [
    "STALE_AFTER",
    "STALE_PERIODS",
    "LivenessTracker",
    "buffered_period",
    "is_stale",
    "median_interval",
    "stale_limit",
    "stamp_intervals",
    "usual_gap",
    "usual_period",
]

STALE_AFTER = SECOND
"""An edge is stale only if no transform was received for longer than this, in nanoseconds."""
STALE_PERIODS = 5
"""An edge is stale only if no transform was received for more than this many of its usual periods."""

_MIN_GAP = 500 * MILLISECOND
_GAP_PERIODS = 10


def usual_period(stamps: NDArray[np.int64]) -> float:
    """Return the usual period of an edge: the median interval between consecutive different stamps.

    Args:
        stamps: (N,) int64 nanoseconds, in any order: the stamps of all known transforms, such as those in a recording
        or a buffer.

    Returns:
        Nanoseconds; 0.0 with fewer than two different stamps, where the period is unknown.

    Example:
        >>> usual_period(np.array([0, 100, 200, 900]))
        100.0
    """
    return median_interval(stamp_intervals(stamps))


def stamp_intervals(stamps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the intervals between consecutive different stamps, sorted by time, in nanoseconds."""
    intervals = stamps[1:] - stamps[:-1]
    if (intervals > 0).all():
        return intervals
    stamps = np.unique(stamps)
    return stamps[1:] - stamps[:-1]


def median_interval(intervals: NDArray[np.int64]) -> float:
    """Return the median of the intervals between stamps; 0.0 if there are none."""
    return float(np.median(intervals)) if len(intervals) else 0.0


def usual_gap(period: float) -> int:
    """Return the longest interval between two transforms of an edge that is not a gap.

    Args:
        period: The usual period of the edge in nanoseconds.

    Returns:
        Nanoseconds: ten periods, and at least 500 ms.

    Example:
        >>> usual_gap(20e6), usual_gap(100e6)
        (500000000, 1000000000)
    """
    return max(_MIN_GAP, round(_GAP_PERIODS * period))


@overload
def stale_limit(period: float) -> float: ...
@overload
def stale_limit(period: NDArray[np.float64]) -> NDArray[np.float64]: ...
def stale_limit(period: float | NDArray[np.float64]) -> float | NDArray[np.float64]:
    """Return how long an edge may receive nothing before it is stale.

    Args:
        period: The usual period in nanoseconds (see :func:`usual_period`), or an array of periods, or 0 if unknown.

    Returns:
        Nanoseconds: :data:`STALE_PERIODS` periods, and at least :data:`STALE_AFTER`.

    Example:
        >>> stale_limit(20e6), stale_limit(500e6)
        (1000000000, 2500000000.0)
    """
    if isinstance(period, np.ndarray):
        return np.maximum(STALE_AFTER, STALE_PERIODS * period)
    return max(STALE_AFTER, STALE_PERIODS * period)


def is_stale(silence: float, period: float, *, static: bool = False) -> bool:
    """Return whether an edge, or a publisher, is stale.

    An edge is stale when it is not static and no transform was received for longer than :data:`STALE_AFTER` and
    longer than :data:`STALE_PERIODS` times its usual period.

    Args:
        silence: The time since the last transform was received, in nanoseconds.
        period: Its usual period in nanoseconds, or 0 where it is unknown.
        static: Whether it is static.

    Example:
        >>> is_stale(1.5e9, 20e6), is_stale(1.5e9, 500e6), is_stale(1.5e9, 20e6, static=True)
        (True, False, False)
    """
    return not static and silence > stale_limit(period)


def buffered_period(buffer: Buffer, parent: str, child: str, oldest: int, newest: int, samples: int) -> float:
    """Return the usual period of an edge, computed from the samples in a buffer.

    Args:
        buffer: The buffer that contains the edge.
        parent: The parent frame of the edge in the newest sample.
        child: The child frame.
        oldest: Stamp of the oldest sample in nanoseconds.
        newest: Stamp of the newest sample in nanoseconds.
        samples: The number of samples.

    Returns:
        Nanoseconds: the median interval, see :func:`usual_period`; the mean interval where the parent of the frame
        has changed between these samples.
    """
    if samples < 2:
        return 0.0
    try:
        return usual_period(np.frombuffer(buffer._stamps_between(parent, child, oldest, newest), np.int64))
    except Exception:  # noqa: BLE001 - the lookup fails where the parent has changed; this module is below errors
        return (newest - oldest) / (samples - 1)


class LivenessTracker:
    """Tracks how long each frame of a buffer has received nothing, and which edges are stale.

    A buffer keeps stamps, not receive times. The tracker therefore records when the newest stamp of each edge last
    changed. It must be updated regularly and is used by one thread.

    Args:
        buffer: The buffer whose edges are tracked.
        clock: Returns the time in nanoseconds; it must be monotonic.
    """

    def __init__(self, buffer: Buffer, clock: Callable[[], int] = time.monotonic_ns) -> None:
        self._buffer = buffer
        self._clock = clock
        self._frames: Sequence[FrameInfo] = ()
        self._newest_stamps: NDArray[np.int64] = np.zeros(0, np.int64)
        self._received_at: NDArray[np.int64] = np.zeros(0, np.int64)
        self._stale_limits: NDArray[np.float64] = np.zeros(0)  # inf: never stale
        self._has_known_period: NDArray[np.bool_] = np.zeros(
            0, bool
        )  # whether the limit depends on the period of the edge
        self._next_check = np.inf

    def update(self, frames: Sequence[FrameInfo]) -> None:
        """Record which edges have received transforms since the last update.

        Args:
            frames: All frames of the buffer in its order, from :meth:`coframe.Buffer.frames`.
        """
        count, before = len(frames), len(self._newest_stamps)
        newest = np.fromiter((frame.newest for frame in frames), np.int64, count)
        received = np.full(count, self._clock())
        limits = np.full(count, float(STALE_AFTER))
        known = np.zeros(count, bool)
        kept = min(count, before)
        same = np.flatnonzero(newest[:kept] == self._newest_stamps[:kept])
        for column, last in (
            (received, self._received_at),
            (limits, self._stale_limits),
            (known, self._has_known_period),
        ):
            column[same] = last[same]
        never = np.fromiter((frame.static or not frame.parent for frame in frames), bool, count)
        limits[never] = np.inf
        limits[~never & np.isinf(limits)] = STALE_AFTER  # these were static, or had no parent, at the last update
        self._frames, self._newest_stamps, self._received_at, self._stale_limits, self._has_known_period = (
            frames,
            newest,
            received,
            limits,
            known,
        )
        self._next_check = float((received + limits).min()) if count else np.inf

    def any_stale(self) -> bool:
        """Return whether any edge is stale; cheap unless an edge may be stale."""
        return self._clock() > self._next_check and bool(self.stale().any())

    def silences(self) -> NDArray[np.int64]:
        """Return how long each frame has received nothing, (N,) nanoseconds, or 0 for static frames and roots."""
        silences = self._clock() - self._received_at
        silences[np.isinf(self._stale_limits)] = 0
        return silences

    def stale(self) -> NDArray[np.bool_]:
        """Return whether the edge to the parent of each frame is stale, (N,)."""
        now = self._clock()
        if now <= self._next_check:
            return np.zeros(len(self._frames), bool)
        late = now - self._received_at > self._stale_limits
        # Periods are read only for the few edges that received nothing for longer than STALE_AFTER.
        unknown = np.flatnonzero(late & ~self._has_known_period).tolist()
        if unknown:
            for row in unknown:
                frame = self._frames[row]
                edge = (frame.parent, frame.name, frame.oldest, frame.newest, frame.samples)
                self._stale_limits[row] = stale_limit(buffered_period(self._buffer, *edge))
            self._has_known_period[unknown] = True
            self._next_check = float((self._received_at + self._stale_limits).min())
            late = now - self._received_at > self._stale_limits
        return late
