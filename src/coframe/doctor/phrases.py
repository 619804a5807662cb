"""Names, counts and poses as findings tell them; durations and stamps are in :mod:`coframe.formatting`."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.doctor.edge import Edge

__all__ = ["listed", "quoted", "static_arguments", "times"]

_MOST_LISTED = 5


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


def static_arguments(edge: Edge) -> str:
    """What `coframe static` takes to tell of a link as its last transform does."""
    flags = ("--x", "--y", "--z", "--qx", "--qy", "--qz", "--qw")
    numbers = (edge.values[-1] + 0.0).tolist()
    pose = " ".join(f"{flag} {number}" for flag, number in zip(flags, numbers, strict=True))
    return f"--frame-id {shlex.quote(edge.parent)} --child-frame-id {shlex.quote(edge.child)} {pose}"
