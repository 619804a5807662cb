# SPDX-License-Identifier: Apache-2.0
"""The rule by which messages on several topics are combined if their stamps are not equal.

A combination has one stamp of each queue, and all its stamps together with the new one are less than `slop` apart. Of
all combinations, the first in this order is chosen: the stamp of the first queue is as close to the new one as can be,
then of the second queue, and so on; if two stamps are equally close, the one stored first is used.

Trying all combinations in this order takes time that grows exponentially with the number of queues. Instead,
combinations are grouped by their earliest stamp: an earliest stamp is possible if each queue has a stamp in the
interval of length `slop` that begins with it. The earliest stamps that remain possible after each choice are neighbors.
"""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


def first_match(new: int, queues: Sequence[Iterable[int]], slop: int) -> list[int] | None:
    """Return the chosen stamp of each queue, or None if there is no combination.

    Args:
        new: Stamp of the new message in nanoseconds.
        queues: Stamps of the messages that wait, for each of the other filters.
        slop: Limit of the difference between stamps in nanoseconds, which is not reached.
    """
    candidates: list[list[int]] = []
    for queue in queues:
        near = [stamp for stamp in queue if abs(stamp - new) <= slop]
        if not near:
            return None
        near.sort(key=lambda stamp: abs(stamp - new))
        candidates.append(near)
    closest = [stamps[0] for stamps in candidates]
    if max([new, *closest]) - min([new, *closest]) < slop:
        return closest
    return _search(new, candidates, slop)


def _search(new: int, candidates: list[list[int]], slop: int) -> list[int] | None:
    lows = _possible_lows(new, candidates, slop)
    if not lows:
        return None
    first, last = 0, len(lows)
    chosen: list[int] = []
    for stamps in candidates:
        for stamp in stamps:
            # The intervals that contain this stamp begin after stamp - slop and not after the stamp itself.
            begin = bisect_right(lows, stamp - slop, first, last)
            end = bisect_right(lows, stamp, first, last)
            if begin < end:
                first, last = begin, end
                chosen.append(stamp)
                break
    return chosen


def _possible_lows(new: int, candidates: list[list[int]], slop: int) -> list[int]:
    """Return the sorted start stamps of intervals of length `slop` with the new stamp and one of each queue."""
    events = sorted((stamp, number) for number, stamps in enumerate(candidates) for stamp in stamps)
    lows = sorted({new, *(stamp for stamp, _ in events if new - slop < stamp <= new)}) if slop > 0 else []
    counts = [0] * len(candidates)
    inside = entered = left = 0
    possible: list[int] = []
    for low in lows:
        while entered < len(events) and events[entered][0] < low + slop:
            number = events[entered][1]
            inside += counts[number] == 0
            counts[number] += 1
            entered += 1
        while left < entered and events[left][0] < low:
            number = events[left][1]
            counts[number] -= 1
            inside -= counts[number] == 0
            left += 1
        if inside == len(candidates):
            possible.append(low)
    return possible
