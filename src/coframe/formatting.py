"""Durations and stamps as text for sentences."""

from __future__ import annotations

from coframe.time import DAY, HOUR, MICROSECOND, MILLISECOND, SECOND

__all__ = ["duration", "seconds"]

_UNITS = ((DAY, "days"), (HOUR, "h"), (SECOND, "s"), (MILLISECOND, "ms"), (MICROSECOND, "us"))


def duration(nanoseconds: float) -> str:
    """Return a duration with three digits and a unit, such as ``17.3 ms``."""
    for size, unit in _UNITS:
        number = nanoseconds / size
        if abs(number) >= 0.9995:
            return f"{number:.3g} {unit}" if abs(number) < 999.5 else f"{number:.0f} {unit}"
    return f"{nanoseconds:.0f} ns"


def seconds(nanoseconds: int) -> str:
    """Return a stamp in seconds with all nine decimal places."""
    sign, size = ("-", -nanoseconds) if nanoseconds < 0 else ("", nanoseconds)
    return f"{sign}{size // SECOND}.{size % SECOND:09d}"
