"""When each point of a cloud was measured, as the drivers of lidars write it.

Messages name a field and its type, but no unit. So that is guessed from the values: integers are nanoseconds; floats
are seconds, or nanoseconds where they could not be seconds. Who knows better says so.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["TIME_FIELDS", "UNITS", "PointTimes", "times_in"]

# Ouster; Velodyne; Hesai, RoboSense and Livox; Livox.
TIME_FIELDS = ("t", "time", "timestamp", "offset_time")
UNITS = {"s": 1_000_000_000, "ms": 1_000_000, "us": 1000, "ns": 1}

NO_TIME = np.iinfo(np.int64).min  # as NaT
_LONGEST_SWEEP = 10_000_000_000  # ns: what is further from the message's stamp is no time of a point of it
_SECOND = 1_000_000_000
_DAYS = 100_000_000  # more seconds than any sweep has, fewer than the system's clock
_END = 2.0**62  # ns, in the year 2116


class PointTimes(NamedTuple):
    """When the points of a message were measured.

    Attributes:
        times: (N,) nanoseconds; `NO_TIME` for a point whose time is not a number.
        field: That tells it.
        unit: That its values are taken for, one of `UNITS`.
        absolute: Whether they are stamps themselves; if not, they count from the message's.
    """

    times: NDArray[np.int64]
    field: str
    unit: str
    absolute: bool


def times_in(points: NDArray[Any], stamp: int, field: str | None = None, unit: str | None = None) -> PointTimes | None:
    """The points' own times; None where they have none, or all have the same.

    Values of more than three years are absolute, others count from the stamp.

    Args:
        points: A structured array.
        stamp: That of their message, in nanoseconds.
        field: That tells the times; None: the first of `TIME_FIELDS` that is there.
        unit: Of its values, one of `UNITS`; None: as it is guessed.

    Raises:
        ValueError: There is no such field; or in that unit its values are no times of a sweep.
    """
    names = points.dtype.names or ()
    name = next((name for name in TIME_FIELDS if name in names), None) if field is None else field
    if name is None or not points.size:
        return None
    if name not in names:
        raise ValueError(f"there is no field {name!r} among {', '.join(names)}")
    found = _read(points[name], stamp, name, unit)
    known = found.times[found.times != NO_TIME] if found is not None else np.zeros(0, dtype=np.int64)
    is_sweep = known.size > 0 and np.abs(known - stamp).max() <= _LONGEST_SWEEP
    if not is_sweep and unit is not None:
        raise ValueError(f"the field {name!r} in {unit} is more than {_LONGEST_SWEEP // _SECOND} s off the stamp")
    if found is None or not is_sweep or (known == known[0]).all():
        return None
    return found


def _read(values: NDArray[Any], stamp: int, field: str, unit: str | None) -> PointTimes | None:
    """None for what is no time."""
    if values.dtype.kind not in "iuf":
        return None
    is_float = values.dtype.kind == "f"
    known = np.isfinite(values)
    if not known.any():
        return None
    largest = np.abs(values[known].astype(np.float64)).max()
    unit = unit or ("s" if is_float and not largest > _DAYS * 100 else "ns")
    if not largest * UNITS[unit] < _END:
        return None
    values = np.where(known, values, 0)
    # Seconds of today in a float64 are exact to a quarter of a microsecond.
    times = np.rint(values.astype(np.float64) * UNITS[unit]) if is_float else values.astype(np.int64) * UNITS[unit]
    absolute = bool(largest * UNITS[unit] > _DAYS * _SECOND)
    stamps = (0 if absolute else stamp) + times.astype(np.int64)
    return PointTimes(np.where(known, stamps, NO_TIME), field, unit, absolute)
