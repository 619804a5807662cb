"""When each point of a cloud was measured, as the drivers of lidars write it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["TIME_FIELDS", "times_in"]

# Ouster; Velodyne; Hesai, RoboSense and Livox; Livox.
TIME_FIELDS = ("t", "time", "timestamp", "offset_time")

_LONGEST_SWEEP = 10_000_000_000  # ns: what is further from the message's stamp is no time of a point of it
_SECOND = 1_000_000_000
_DAYS = 100_000_000  # more seconds than any sweep has, fewer than the system's clock
_END = 2.0**62  # ns, in the year 2116


def times_in(points: NDArray[Any], stamp: int) -> NDArray[np.int64] | None:
    """The points' own times in nanoseconds, (N,); None where they have none, or all have the same.

    Integers are nanoseconds; floats are seconds, or nanoseconds where they could not be. Small ones count from the
    stamp, large ones are absolute.

    Args:
        points: A structured array.
        stamp: That of their message.
    """
    name = next((name for name in TIME_FIELDS if name in (points.dtype.names or ())), None)
    if name is None or not points.size:
        return None
    times = _absolute(points[name], stamp)
    if times is None or np.abs(times - stamp).max() > _LONGEST_SWEEP or (times == times[0]).all():
        return None
    return times


def _absolute(values: NDArray[Any], stamp: int) -> NDArray[np.int64] | None:
    """None for what is no time."""
    largest = np.abs(values.astype(np.float64)).max()
    if values.dtype.kind not in "iuf" or not largest < _END:
        return None
    if values.dtype.kind != "f":
        return values.astype(np.int64) + (0 if largest > _DAYS * _SECOND else stamp)
    # Seconds of today in a float64 are exact to a quarter of a microsecond.
    scale = 1 if largest > _DAYS * 100 else _SECOND
    since = 0 if largest > _DAYS else stamp
    return np.asarray(since + np.rint(values.astype(np.float64) * scale).astype(np.int64))
