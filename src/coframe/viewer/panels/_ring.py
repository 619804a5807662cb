# SPDX-License-Identifier: Apache-2.0
"""The last points of a live curve."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe.time import SECOND

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Points", "Ring"]

# Times may be slightly out of order. A larger step back is a restart, for example of a simulation.
_MAX_STEP_BACK = SECOND


class Points(NamedTuple):
    """Points of a curve.

    Attributes:
        times: (N,) int64 nanoseconds, in order.
        values: (N,); NaN is a gap.
    """

    times: NDArray[np.int64]
    values: NDArray[np.float64]


class Ring:
    """The last points of a curve, in order.

    Args:
        capacity: The number of points to keep.

    Attributes:
        total: The number of points that were added since the last restart.
        restarts: The number of times that time restarted.
    """

    def __init__(self, capacity: int = 20_000) -> None:
        self.total = 0
        self.restarts = 0
        self._capacity = capacity
        self._times = np.empty(2 * capacity, dtype=np.int64)
        self._values = np.empty(2 * capacity)
        self._end = 0

    def __len__(self) -> int:
        return min(self.total, self._capacity)

    @property
    def last(self) -> int | None:
        """The time of the last point, or None if there is none."""
        return int(self._times[self._end - 1]) if self._end else None

    def clear(self) -> None:
        """Discard all points."""
        self._end = self.total = 0
        self.restarts += 1

    def add(self, times: NDArray[np.int64], values: NDArray[np.float64]) -> None:
        """Add points. Times that are slightly too early are set to the last time."""
        if not len(times):
            return
        if self.last is not None and times[-1] < self.last - _MAX_STEP_BACK:
            self.clear()
        times, values = times[-self._capacity :], values[-self._capacity :]
        if self._end + len(times) > len(self._times):
            kept = self._capacity
            self._times[:kept] = self._times[self._end - kept : self._end]
            self._values[:kept] = self._values[self._end - kept : self._end]
            self._end = kept
        earliest = times[0] if self.last is None else max(self.last, int(times[0]))
        end = self._end + len(times)
        self._times[self._end : end] = np.maximum.accumulate(np.maximum(times, earliest))
        self._values[self._end : end] = values
        self._end = end
        self.total += len(times)

    def since(self, seen: int) -> Points:
        """Return copies of the points after the first ``seen`` ones, if they are still stored."""
        count = min(max(self.total - seen, 0), len(self))
        part = slice(self._end - count, self._end)
        return Points(self._times[part].copy(), self._values[part].copy())
