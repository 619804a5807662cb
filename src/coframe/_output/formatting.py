# SPDX-License-Identifier: Apache-2.0
"""Format durations, stamps, counts and lists of names for messages."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

from coframe.time import DAY, HOUR, MICROSECOND, MILLISECOND, SECOND

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe._base_error import CoframeError

__all__ = [
    "MAX_COMPARED_LENGTH",
    "MAX_COMPARED_NAMES",
    "count",
    "did_you_mean",
    "duration",
    "error_text",
    "join_names",
    "join_quoted",
    "seconds",
    "similar_names",
    "times",
]

_UNITS = ((DAY, "days"), (HOUR, "h"), (SECOND, "s"), (MILLISECOND, "ms"), (MICROSECOND, "us"))
_MAX_LISTED_NAMES = 5
MAX_COMPARED_LENGTH = 200  # characters; the time grows with the square
MAX_COMPARED_NAMES = 20_000


def duration(nanoseconds: float) -> str:
    """Return a duration with three digits and a unit.

    Example:
        >>> duration(17_300_000), duration(90e9)
        ('17.3 ms', '90 s')
    """
    for size, unit in _UNITS:
        number = nanoseconds / size
        if abs(number) >= 0.9995:
            return f"{number:.3g} {unit}" if abs(number) < 999.5 else f"{number:.0f} {unit}"
    return f"{nanoseconds:.0f} ns"


def rounded_duration(seconds: float) -> str:
    """Return a duration as a whole number of seconds, minutes or hours, for text that is updated.

    Example:
        >>> rounded_duration(12.3), rounded_duration(1020.0)
        ('12 s', '17 min')
    """
    if seconds < 99.5:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5970.0 else f"{seconds / 3600:.1f} h"


def seconds(nanoseconds: int) -> str:
    """Return a stamp in seconds with all nine digits."""
    sign, size = ("-", -nanoseconds) if nanoseconds < 0 else ("", nanoseconds)
    return f"{sign}{size // SECOND}.{size % SECOND:09d}"


def join_names(names: Iterable[str], *, limit: int = _MAX_LISTED_NAMES) -> str:
    """Return names as a comma-separated list: at most `limit` names, then the number of the others.

    Example:
        >>> join_names("abc"), join_names("abcdefg")
        ('a, b, c', 'a, b, c, d, e and 2 more')
    """
    every = list(names)
    more = len(every) - limit
    return ", ".join(every[:limit]) + (f" and {more} more" if more > 0 else "")


def join_quoted(names: Iterable[str]) -> str:
    """Return a list of quoted names, shortened as in :func:`join_names`."""
    return join_names(repr(name) for name in names)


def did_you_mean(name: str, known: Iterable[str], *, limit: int = 1) -> str:
    """Return a question that suggests names with a similar spelling; empty if there are none.

    Example:
        >>> did_you_mean("lidra", ["lidar", "camera"])
        "Did you mean 'lidar'?"
    """
    meant = similar_names(name, known, limit=limit)
    return f"Did you mean {' or '.join(map(repr, meant))}?" if meant else ""


def similar_names(name: str, known: Iterable[str], *, limit: int = 1) -> list[str]:
    """Return the names with the most similar spelling. Very long names and names beyond a limit are skipped."""
    import difflib  # noqa: PLC0415 - only errors need it

    if len(name) > MAX_COMPARED_LENGTH:
        return []
    compared = islice((each for each in known if len(each) <= MAX_COMPARED_LENGTH), MAX_COMPARED_NAMES)
    return difflib.get_close_matches(name, list(compared), n=limit)


def times(number: int) -> str:
    """Return ``once``, ``twice`` or ``3 times``."""
    return {1: "once", 2: "twice"}.get(number, f"{number} times")


def error_text(error: CoframeError) -> str:
    """Return the message of an error and its hint as sentences of one line."""
    text = str(error)
    return f"{text}{'' if text.endswith(('.', '!', '?')) else '.'} {error.hint}" if error.hint else text


def count(number: int, noun: str) -> str:
    """Return a number and a noun, in the plural unless the number is 1.

    Example:
        >>> count(1, "frame"), count(2, "frame")
        ('1 frame', '2 frames')
    """
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
