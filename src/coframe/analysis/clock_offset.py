# SPDX-License-Identifier: Apache-2.0
"""The offset of a clock: how far stamps are behind their arrival, with the spread and the drift."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import coframe.lazy_numpy as np
from coframe._output.formatting import duration
from coframe.time import MICROSECOND, SECOND

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["ClockOffset", "clock_offset"]

_MAX_SAMPLES = 20_000
_BINS = 24
_MIN_BINS = 8
_MIN_PER_BIN = 4
_MAD_TO_DEVIATION = (
    1.4826  # The standard deviation of a normal distribution is this multiple of its median absolute deviation.
)
_MIN_SLOPE_RATIO = 6.0  # times the standard error of the slope
_MAX_CURVATURE = 0.2  # of the whole change; a step of the clock is not a drift
_MIN_CHANGE = MICROSECOND
_PPM = 1e6


class ClockOffset(NamedTuple):
    """How far stamps are behind their arrival. Times are nanoseconds.

    Attributes:
        offset: The median of arrival minus stamp; negative if the stamps are ahead.
        spread: The robust standard deviation of this delay, without the drift.
        drift: By how much the stamps fall behind, in parts per million, or None if it is not significant.
    """

    offset: float
    spread: float
    drift: float | None

    @property
    def size(self) -> str:
        """The offset without its direction, with the spread and the drift: ``3600.003 s +-0.2 ms, drift 12 ppm``."""
        size = abs(self.offset)
        number = f"{size / SECOND:.3f} s" if size >= SECOND else duration(size)
        if self.drift is None:
            return f"{number} +-{duration(self.spread)}"
        return f"{number} +-{duration(self.spread)}, drift {self.drift:.3g} ppm"

    @property
    def direction(self) -> str:
        """``behind`` or ``ahead of``."""
        return "ahead of" if self.offset < 0 else "behind"


def clock_offset(lags: NDArray[np.int64], arrival_times: NDArray[np.int64]) -> ClockOffset:
    """Return the offset of stamps from their delays.

    The drift is the slope of the delays over time. It is reported if it is linear, many times its standard error, and
    changes the delay by more than the delay varies.

    Args:
        lags: (N,) arrival minus stamp in nanoseconds, N >= 1.
        arrival_times: (N,) time of arrival in nanoseconds.

    Example:
        >>> arrived = np.arange(1000) * 10_000_000
        >>> clock_offset(arrived // 50_000 + 5_000_000_000, arrived).size
        '5.000 s +-0 ns, drift 20 ppm'
    """
    every = -(-len(lags) // _MAX_SAMPLES)
    lags, arrival_times = lags[::every], arrival_times[::every]
    middle = int(np.median(lags))  # Subtracting it keeps the precision of floats.
    y, x = (lags - middle).astype(np.float64), (arrival_times - arrival_times[0]).astype(np.float64)
    slope = _slope(x, y)
    rest = y - slope * (x - np.median(x))
    spread = _MAD_TO_DEVIATION * float(np.median(np.abs(rest - np.median(rest))))
    change = abs(slope) * float(np.ptp(x)) if len(x) else 0.0
    if change < max(spread, _MIN_CHANGE):
        spread = _MAD_TO_DEVIATION * float(np.median(np.abs(y - np.median(y))))
        return ClockOffset(float(middle), spread, None)
    return ClockOffset(float(middle), spread, slope * _PPM)


def _slope(x: NDArray[np.float64], y: NDArray[np.float64]) -> float:
    """Return the slope of y over x if it is linear and significant, from the medians of equal parts; otherwise 0."""
    bins = min(_BINS, len(x) // _MIN_PER_BIN)
    if bins < _MIN_BINS:
        return 0.0
    order = np.argsort(x, kind="stable")
    parts = np.array_split(order, bins)
    centers = np.array([np.median(x[part]) for part in parts])
    medians = np.array([np.median(y[part]) for part in parts])
    if np.ptp(centers) == 0.0:
        return 0.0
    rows, columns = np.triu_indices(bins, 1)
    apart = centers[columns] - centers[rows]
    slope = float(np.median((medians[columns] - medians[rows])[apart > 0] / apart[apart > 0]))
    rest = medians - slope * centers
    rest -= np.median(rest)
    change = abs(slope) * float(np.ptp(centers))
    error = float(np.sqrt(np.sum(rest**2) / (bins - 2) / np.sum((centers - centers.mean()) ** 2)))
    is_linear = float(np.abs(rest).max()) <= _MAX_CURVATURE * change
    return slope if is_linear and abs(slope) > _MIN_SLOPE_RATIO * error else 0.0
