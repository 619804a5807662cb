"""Numbers and names as findings tell them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["duration", "listed", "quoted", "seconds", "times"]

_UNITS = ((86_400e9, "days"), (3_600e9, "h"), (1e9, "s"), (1e6, "ms"), (1e3, "us"))
_MOST_LISTED = 5


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


def listed(names: Iterable[str]) -> str:
    """``a, b, c``; of many the first ones and how many more."""
    every = list(names)
    more = len(every) - _MOST_LISTED
    return ", ".join(every[:_MOST_LISTED]) + (f" and {more} more" if more > 0 else "")


def quoted(names: Iterable[str]) -> str:
    """``'a', 'b', 'c'``, likewise."""
    return listed(repr(name) for name in names)


def times(count: int) -> str:
    """``once``, ``twice``, ``3 times``."""
    return {1: "once", 2: "twice"}.get(count, f"{count} times")
