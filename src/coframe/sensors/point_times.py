# SPDX-License-Identifier: Apache-2.0
"""The time of each point of a cloud, as published by lidar drivers.

A message contains the name and type of the time field, but not its unit, which is therefore guessed from the values:
integers are nanoseconds; floats are seconds, or nanoseconds if they are too large for seconds. Callers that know the
unit should pass it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.time import MICROSECOND, MILLISECOND, SECOND

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["TIME_FIELDS", "UNITS", "PointTimes", "times_in"]

# The fields of Ouster; of Velodyne; of Hesai, RoboSense and Livox; of Livox.
TIME_FIELDS = ("t", "time", "timestamp", "offset_time")
UNITS = {"s": SECOND, "ms": MILLISECOND, "us": MICROSECOND, "ns": 1}

NO_TIME = np.iinfo(np.int64).min  # The integer of NumPy's NaT.
_MAX_SWEEP = 10 * SECOND  # Values that differ more from the message's stamp are not times of its points.
_MAX_OFFSET = 100_000_000  # Seconds, about three years: larger values are absolute times.
_LATEST = 2.0**62  # Nanoseconds, in the year 2116.


class PointTimes(NamedTuple):
    """The times of the points of a message.

    Attributes:
        times: Nanoseconds, shape (N,); `NO_TIME` for a point whose time is not a number.
        field: Name of the time field.
        unit: Unit of its values, one of `UNITS`.
        absolute: Whether the values are stamps; otherwise they are relative to the stamp of the message.
    """

    times: NDArray[np.int64]
    field: str
    unit: str
    absolute: bool


def times_in(points: NDArray[Any], stamp: int, field: str | None = None, unit: str | None = None) -> PointTimes | None:
    """Return the times of the points; None if they have no times, or all have the same.

    Values of more than three years are absolute; others are relative to the stamp.

    Args:
        points: A structured array.
        stamp: Stamp of the message in nanoseconds.
        field: Name of the time field; None uses the first of `TIME_FIELDS` that exists.
        unit: Unit of the values, one of `UNITS`; None guesses it.

    Raises:
        ValueError: The field does not exist, or its values in this unit are not near the stamp.
    """
    names = points.dtype.names or ()
    name = next((name for name in TIME_FIELDS if name in names), None) if field is None else field
    if name is None or not points.size:
        return None
    if name not in names:
        raise ValueError(f"the points have no field {name!r}. Their fields: {', '.join(names)}.")
    found = _read(points[name], stamp, name, unit)
    known = found.times[found.times != NO_TIME] if found is not None else np.zeros(0, dtype=np.int64)
    is_sweep = known.size > 0 and np.abs(known - stamp).max() <= _MAX_SWEEP
    if not is_sweep and unit is not None:
        raise ValueError(
            f"the times in field {name!r}, read in {unit}, differ from the stamp by more than {_MAX_SWEEP // SECOND} s"
        )
    if found is None or not is_sweep or (known == known[0]).all():
        return None
    return found


def _read(values: NDArray[Any], stamp: int, field: str, unit: str | None) -> PointTimes | None:
    """Return the times in a field; None if its values cannot be times."""
    if values.dtype.kind not in "iuf":
        return None
    is_float = values.dtype.kind == "f"
    known = np.isfinite(values)
    if not known.any():
        return None
    largest = np.abs(values[known].astype(np.float64)).max()
    unit = unit or ("s" if is_float and not largest > _MAX_OFFSET * 100 else "ns")
    if not largest * UNITS[unit] < _LATEST:
        return None
    values = np.where(known, values, 0)
    # A float64 holds the current time in seconds with a resolution of a quarter of a microsecond.
    times = np.rint(values.astype(np.float64) * UNITS[unit]) if is_float else values.astype(np.int64) * UNITS[unit]
    absolute = bool(largest * UNITS[unit] > _MAX_OFFSET * SECOND)
    stamps = (0 if absolute else stamp) + times.astype(np.int64)
    return PointTimes(np.where(known, stamps, NO_TIME), field, unit, absolute)
