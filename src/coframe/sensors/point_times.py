# SPDX-License-Identifier: Apache-2.0
"""The time of each point of a cloud, as published by lidar drivers.

A message contains the name and type of the time field, but not its unit, which is therefore found out from the values:
usually integers are nanoseconds, and floats are seconds. Where the sweep would then be much shorter or longer than the
period of the messages, the unit counts in which it is not. Callers that know the unit should pass it.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe._base_error import CoframeError
from coframe._output.formatting import duration
from coframe.time import MICROSECOND, MILLISECOND, SECOND

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

__all__ = [
    "DESKEWED_PREFIX",
    "TIME_FIELDS",
    "UNITS",
    "PointTimes",
    "UnknownTimesError",
    "implausible_sweep_reason",
    "likely_times",
    "read_times",
]

# The fields of Ouster; of Velodyne; of Hesai, RoboSense and Livox; of Livox; of Aeva, Innovusion and others.
TIME_FIELDS = ("t", "time", "timestamp", "offset_time", "time_offset", "timeOffset", "time_stamp", "ts")
DESKEWED_PREFIX = "deskewed_"
"""Begins the name of a field with the times of points that were deskewed, so that no reader deskews them again."""
UNITS = {"s": SECOND, "ms": MILLISECOND, "us": MICROSECOND, "ns": 1}

NO_TIME = np.iinfo(np.int64).min  # The integer of NumPy's NaT.
_MAX_SWEEP = 10 * SECOND  # Values that differ more from the message's stamp are not times of its points.
_MAX_OFFSET = 100_000_000 * SECOND  # About three years: larger values are absolute times.
_MAX_TIME = 2.0**62  # Nanoseconds, in the year 2116.
# Sweeps of spinning and solid-state lidars, including those whose messages were thinned out.
_MIN_USUAL_SWEEP, _MAX_USUAL_SWEEP = 5 * MILLISECOND, SECOND
# The sweep of a message in periods: two lidars may share a topic, and some lidars rest between two sweeps.
_MIN_PERIODS, _MAX_PERIODS = 1 / 30, 3.0
# Not of points that were deskewed already.
_TIME_FIELD_NAME = re.compile(r"^(?!deskewed_).*(time|stamp)|^(t|dt)?_?(ms|us|ns|sec|usec|nsec)$|^d?t_", re.IGNORECASE)
_USUAL_PERIOD = 100 * MILLISECOND  # Of a topic with one message.


class UnknownTimesError(CoframeError, ValueError):
    """The points have a field of times, but its unit cannot be found out."""


class PointTimes(NamedTuple):
    """The times of the points of a message.

    Attributes:
        times: Nanoseconds, shape (N,); `NO_TIME` for a point whose time is not a number.
        field: Name of the time field.
        unit: Unit of its values, one of `UNITS`.
        absolute: Whether the values are stamps; otherwise they are relative to the stamp of the message.
        sweep: The interval from the first to the last point in nanoseconds.
        found: Whether the unit was found out from the length of the sweep.
    """

    times: NDArray[np.int64]
    field: str
    unit: str
    absolute: bool
    sweep: int
    found: bool = False


def read_times(
    points: NDArray[Any], stamp: int, field: str | None = None, unit: str | None = None, *, period: int = 0
) -> PointTimes | None:
    """Return the times of the points, or None if they have no times, or all have the same.

    Values of more than three years are absolute; others are relative to the stamp.

    Args:
        points: A structured array.
        stamp: Stamp of the message in nanoseconds.
        field: Name of the time field; None uses the first of `TIME_FIELDS` that exists.
        unit: Unit of the values, one of `UNITS`; None finds it out.
        period: The usual interval between the messages in nanoseconds, or 0 if it is unknown.

    Raises:
        UnknownTimesError: The field has times in no known unit.
        ValueError: The field does not exist, or its values in this unit are not near the stamp.
    """
    names = points.dtype.names or ()
    name = next((name for name in TIME_FIELDS if name in names), None) if field is None else field
    if name is None or not points.size:
        return None
    if name not in names:
        raise ValueError(f"the points have no field {name!r}. Their fields: {', '.join(names)}.")
    values = points[name]
    known = values[np.isfinite(values)] if values.dtype.kind in "iuf" else values[:0]
    if not known.size:
        return None
    if unit is not None:
        found = _read_field(values, stamp, name, unit)
        if found is None:
            limit = _MAX_SWEEP // SECOND
            raise ValueError(
                f"the times in field {name!r}, read in {unit}, differ from the stamp by more than {limit} s"
            )
        return found if found.sweep else None
    if known.min() == known.max():
        return None
    usual = "s" if values.dtype.kind == "f" else "ns"
    readings = [one for each in UNITS if (one := _read_field(values, stamp, name, each)) is not None and one.sweep]
    chosen = _most_plausible(readings, usual, period)
    if chosen is None:
        raise UnknownTimesError(
            f"the field {name!r} has values from {known.min():.9g} to {known.max():.9g}, whose unit is unknown; "
            f"give the unit, for example {name}:ms"
        )
    return chosen


def likely_times(names: Sequence[str]) -> list[str]:
    """Return the names that are no known field of times, but sound like one."""
    return [name for name in names if name not in TIME_FIELDS and _TIME_FIELD_NAME.search(name)]


def implausible_sweep_reason(times: PointTimes, period: int) -> str:
    """Return why a sweep does not fit the interval between messages, or "" if it does, or the interval is unknown."""
    if not period or _is_plausible(times, period):
        return ""
    return (
        f"the field {times.field} read in {times.unit} results in a sweep of {duration(times.sweep)}, but there is a "
        f"message every {duration(period)}"
    )


def _most_plausible(readings: list[PointTimes], usual: str, period: int) -> PointTimes | None:
    """Return the interpretation in the usual unit if it is plausible, else the one with the most plausible sweep."""
    expected = period or _USUAL_PERIOD
    fitting = [one for one in readings if _is_plausible(one, expected)]
    # Stamps are near that of the message in one unit only.
    conventional = [one for one in readings if one.unit == usual or one.absolute]
    if conventional and (not fitting or any(one is conventional[0] for one in fitting)):
        return conventional[0]
    nearest = min(fitting, key=lambda one: abs(math.log(one.sweep / expected)), default=None)
    return None if nearest is None else nearest._replace(found=True)


def _is_plausible(times: PointTimes, period: int) -> bool:
    periods = times.sweep / period
    return periods <= _MAX_PERIODS and (periods >= _MIN_PERIODS or _MIN_USUAL_SWEEP <= times.sweep <= _MAX_USUAL_SWEEP)


def _read_field(values: NDArray[Any], stamp: int, field: str, unit: str) -> PointTimes | None:
    """Convert the times of a field from one unit, or None if they are not near the stamp."""
    known = np.isfinite(values)
    largest = float(np.abs(values[known].astype(np.float64)).max()) * UNITS[unit]
    if not largest < _MAX_TIME:
        return None
    numbers = np.where(known, values, 0)
    # A float64 holds the current time in seconds with a resolution of a quarter of a microsecond.
    is_float = values.dtype.kind == "f"
    times = np.rint(numbers.astype(np.float64) * UNITS[unit]) if is_float else numbers.astype(np.int64) * UNITS[unit]
    absolute = largest > _MAX_OFFSET
    stamps = (0 if absolute else stamp) + times.astype(np.int64)
    near = stamps[known]
    first, last = int(near.min()), int(near.max())
    if max(abs(first - stamp), abs(last - stamp)) > _MAX_SWEEP:
        return None
    return PointTimes(np.where(known, stamps, NO_TIME), field, unit, absolute, last - first)
