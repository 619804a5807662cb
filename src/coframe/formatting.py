"""Durations and stamps as sentences tell them."""

from __future__ import annotations

__all__ = ["duration", "seconds"]

_UNITS = ((86_400e9, "days"), (3_600e9, "h"), (1e9, "s"), (1e6, "ms"), (1e3, "us"))


def duration(nanoseconds: float) -> str:
    """Three digits and a unit: ``17.3 ms``."""
    for size, unit in _UNITS:
        number = nanoseconds / size
        if abs(number) >= 0.9995:
            return f"{number:.3g} {unit}" if abs(number) < 999.5 else f"{number:.0f} {unit}"
    return f"{nanoseconds:.0f} ns"


def seconds(nanoseconds: int) -> str:
    """A stamp, with all nine digits."""
    sign, size = ("-", -nanoseconds) if nanoseconds < 0 else ("", nanoseconds)
    return f"{sign}{size // 10**9}.{size % 10**9:09d}"
