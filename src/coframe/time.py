# SPDX-License-Identifier: Apache-2.0
"""Convert times and durations to int64 nanoseconds; units of time.

Floats of seconds are never accepted: a float64 cannot hold the current time to the nanosecond.
"""

from __future__ import annotations

import datetime
import math
import operator
import re
from typing import Any, Protocol, SupportsIndex, TypeAlias

import coframe.lazy_numpy as np

__all__ = [
    "DAY",
    "HOUR",
    "MICROSECOND",
    "MILLISECOND",
    "MINUTE",
    "MIN_INT_NANOSECONDS",
    "SECOND",
    "DurationLike",
    "StampLike",
    "duration_ns",
    "duration_seconds",
    "stamp_ns",
]

# Units of time in nanoseconds. Import them from here; the package does not define them anywhere else.
MICROSECOND = 1_000
MILLISECOND = 1_000_000
SECOND = 1_000_000_000
MINUTE = 60 * SECOND
HOUR = 3_600 * SECOND
DAY = 86_400 * SECOND

# Smaller ints are rejected as durations: a day has 86 400 seconds, and no timeout or cache is below 100 us.
# The native core has the same limit (is_meant_as_seconds).
MIN_INT_NANOSECONDS = 100 * MICROSECOND

_UNITS = {"ns": 1, "us": MICROSECOND, "ms": MILLISECOND, "s": SECOND, "min": MINUTE, "h": HOUR}
_DURATION = re.compile(r"\s*(\d+)(?:\.(\d+))?\s*([a-z]+)\s*", re.ASCII)


class HasNanoseconds(Protocol):
    """An object such as rclpy's Time or Duration."""

    @property
    def nanoseconds(self) -> int: ...


class HasSecNanosec(Protocol):
    """A message such as Time or Duration of builtin_interfaces."""

    @property
    def sec(self) -> int: ...
    @property
    def nanosec(self) -> int: ...


StampLike: TypeAlias = "SupportsIndex | np.datetime64 | datetime.datetime | HasNanoseconds | HasSecNanosec"
DurationLike: TypeAlias = "SupportsIndex | str | datetime.timedelta | np.timedelta64 | HasNanoseconds | HasSecNanosec"


def stamp_ns(stamp: StampLike) -> int:
    """Return a point in time as nanoseconds since the epoch.

    Args:
        stamp: int nanoseconds, numpy.datetime64, an aware datetime, rclpy's Time or a Time message.

    Raises:
        TypeError: The stamp has another type, such as a float of seconds.
        ValueError: The stamp is a datetime without a time zone, is NaT, or does not fit into 64 bits.

    Example:
        >>> import numpy as np
        >>> stamp_ns(np.datetime64("1970-01-01T00:00:01.5"))
        1500000000
    """
    if np.is_scalar(stamp) and isinstance(stamp, np.datetime64):
        if np.isnat(stamp):
            raise ValueError("a stamp must not be NaT")
        return int(stamp.astype("datetime64[ns]").astype(np.int64))
    if isinstance(stamp, datetime.datetime):
        if stamp.tzinfo is None:
            raise ValueError(f"the datetime {stamp} has no time zone. Give it one, such as datetime.timezone.utc.")
        return _timedelta_ns(stamp - datetime.datetime.fromtimestamp(0, datetime.timezone.utc))
    return _check_range(_number_to_ns(stamp, "a stamp", "int nanoseconds, numpy.datetime64, datetime or a Time"))


def duration_ns(duration: DurationLike) -> int:
    """Return a duration as nanoseconds.

    Args:
        duration: A string such as ``"100ms"`` or ``"1.5s"`` (units ns, us, ms, s, min, h), int nanoseconds,
            ``timedelta``, numpy.timedelta64, rclpy's Duration or a Duration message. A positive int below 100 000
            is rejected, because the caller most likely means seconds; pass durations below 100 us in another form.

    Raises:
        TypeError: The duration has another type, such as a float of seconds.
        ValueError: The string is not a number with a unit, or the duration is NaT, does not fit into 64 bits, or is a
            positive int below 100 000.

    Example:
        >>> duration_ns("1.5s")
        1500000000
    """
    if isinstance(duration, str):
        return _check_range(_parse_duration(duration))
    if isinstance(duration, datetime.timedelta):
        return _timedelta_ns(duration)
    if np.is_scalar(duration) and isinstance(duration, np.timedelta64):
        if np.isnat(duration):
            raise ValueError("a duration must not be NaT")
        return int(duration.astype("timedelta64[ns]").astype(np.int64))
    accepted = 'a string such as "100ms", int nanoseconds, timedelta or a Duration'
    if isinstance(duration, float):
        raise TypeError(f"a duration must be {accepted}, not float. {_unit_hint(duration)}")
    nanoseconds = _check_range(_number_to_ns(duration, "a duration", accepted))
    if (
        0 < nanoseconds < MIN_INT_NANOSECONDS
        and isinstance(duration, SupportsIndex)
        and not hasattr(duration, "nanoseconds")
    ):
        raise ValueError(
            f"the duration {nanoseconds} has no unit: an int is in nanoseconds. For seconds, write "
            f'"{nanoseconds}s" or {nanoseconds * SECOND:_}; for nanoseconds, write "{nanoseconds}ns".'
        )
    return nanoseconds


def duration_seconds(duration: DurationLike | None) -> float | None:
    """Return a timeout as seconds, as the modules of Python expect it, or None for None.

    Raises:
        TypeError: As :func:`duration_ns`.
        ValueError: As :func:`duration_ns`.

    Example:
        >>> duration_seconds("500ms")
        0.5
    """
    return None if duration is None else duration_ns(duration) / SECOND


def _unit_hint(seconds: float) -> str:
    """Return how to write a duration that was given as a float, which probably means seconds."""
    if not math.isfinite(seconds):
        return f"{seconds} is not a duration."
    return f'For {seconds:g} seconds, write "{np.format_float_positional(seconds, trim="-")}s".'


def _check_range(nanoseconds: int) -> int:
    if not -(2**63) <= nanoseconds < 2**63:
        raise ValueError(f"{nanoseconds} ns does not fit into 64 bits, which hold 292 years")
    return nanoseconds


def _parse_duration(text: str) -> int:
    match = _DURATION.fullmatch(text)
    if match is None or match[3] not in _UNITS:
        units = ", ".join(_UNITS)
        raise ValueError(f'{text!r} is not a duration. Write a number and a unit ({units}), such as "100ms".')
    integer_part, fraction, unit = match[1], match[2] or "", _UNITS[match[3]]
    scale: int = 10 ** len(fraction)
    return int(integer_part) * unit + int(fraction or "0") * unit // scale


def _timedelta_ns(delta: datetime.timedelta) -> int:
    return delta.days * DAY + delta.seconds * SECOND + delta.microseconds * MICROSECOND


def _number_to_ns(value: Any, name: str, accepted: str) -> int:
    try:
        return int(operator.index(value))
    except TypeError:
        pass
    if hasattr(value, "nanosec") and hasattr(value, "sec"):
        return int(value.sec) * SECOND + int(value.nanosec)
    if hasattr(value, "nanoseconds"):
        return int(value.nanoseconds)
    reason = (
        ". A float of seconds cannot hold the current time to the nanosecond: write the nanoseconds as an int, such as "
        "1_500_000_000."
        if isinstance(value, float)
        else ""
    )
    raise TypeError(f"{name} must be {accepted}, not {type(value).__name__}{reason}")


def __dir__() -> list[str]:
    return sorted(__all__)
