# SPDX-License-Identifier: Apache-2.0
"""Decide which clock stamps come from: the system clock, simulated time, or another clock."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Literal

from coframe.time import HOUR, MINUTE

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["SAME_CLOCK", "ClockName", "clock_of", "current_time_for", "group_by_clock", "is_same_clock"]

ClockName = Literal["wall", "simulated", "other"]

SAME_CLOCK = HOUR - MINUTE
"""Times that differ by at least this much, in nanoseconds, are from different clocks: no delay is that long.

Messages from a clock that is an hour ahead arrive less than an hour before their stamps.
"""
# Simulated time is compared with /clock at the receive time, so the difference is much smaller.
_SAME_SIMULATED_CLOCK = MINUTE


def is_same_clock(first: float, second: float) -> bool:
    """Return whether two times, in nanoseconds, can be from the same clock."""
    return abs(first - second) < SAME_CLOCK


def clock_of(wall_lag: float, simulated_lag: float | None = None) -> ClockName:
    """Return which clock stamps come from.

    Args:
        wall_lag: The median of receive time minus stamp, in nanoseconds.
        simulated_lag: The median of the simulated time at reception minus stamp, in nanoseconds, or None without
            simulated time.

    Returns:
        "wall" for the system clock, "simulated" for the time of /clock, else "other".

    Example:
        >>> clock_of(20e6), clock_of(1.7e18, 5e6), clock_of(1.7e18)
        ('wall', 'simulated', 'other')
    """
    if simulated_lag is not None and abs(simulated_lag) < _SAME_SIMULATED_CLOCK:
        return "simulated"
    return "wall" if abs(wall_lag) < SAME_CLOCK else "other"


def group_by_clock(spans: Sequence[tuple[int, int]]) -> list[list[int]]:
    """Group time spans by clock: spans less than :data:`SAME_CLOCK` apart share a clock.

    Args:
        spans: The first and the last time of each span, in nanoseconds.

    Returns:
        The indices of the spans of each clock, starting with the clock with the earliest time.

    Example:
        >>> from coframe.time import DAY, SECOND
        >>> group_by_clock([(0, SECOND), (DAY, DAY + SECOND), (2 * SECOND, 3 * SECOND)])
        [[0, 2], [1]]
    """
    groups: list[list[int]] = []
    latest = 0
    for position in sorted(range(len(spans)), key=lambda position: spans[position]):
        first, last = spans[position]
        if not groups or first > latest + SAME_CLOCK:
            groups.append([])
            latest = last
        groups[-1].append(position)
        latest = max(latest, last)
    return groups


def current_time_for(newest: int, wall: int | None = None) -> int | None:
    """Return the current time on the clock of the stamps that are being received.

    Args:
        newest: The newest stamp, in nanoseconds.
        wall: The system time in nanoseconds; None to read the clock.

    Returns:
        The system time if the newest stamp can be from the system clock; otherwise None, because the current time is
        unknown.
    """
    now = time.time_ns() if wall is None else wall
    return now if is_same_clock(now, newest) else None
