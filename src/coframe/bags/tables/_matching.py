# SPDX-License-Identifier: Apache-2.0
"""Find the messages that provide the value at each time, by their stamps."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.bags.tables.columns import Method

__all__ = ["MatchedRows", "pick"]

_MAX_STAMP = np.iinfo(np.int64).max


class MatchedRows(NamedTuple):
    """The samples for each of N times.

    Attributes:
        first: Index of the sample, or of the one before the time for interpolation, (N,).
        second: Index of the sample after the time for interpolation; otherwise the same as ``first``, (N,).
        share: Weight of the second sample, 0 to 1, (N,).
        valid: Whether there is a sample, or one on each side, within the limits, (N,).
        age: The time minus the stamp of the sample; for interpolation, of the nearer one, in nanoseconds, (N,).
        gap: The interval between the two samples, in nanoseconds, (N,); 0 at the stamp of a sample.
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    share: NDArray[np.float64]
    valid: NDArray[np.bool_]
    age: NDArray[np.int64]
    gap: NDArray[np.int64]


def pick(
    samples: NDArray[np.int64], times: NDArray[np.int64], method: Method, tolerance: int | None, max_gap: int | None
) -> MatchedRows:
    """Return which samples the values at some times come from.

    Of samples with equal stamps, the last one counts. If two are equally near, it is the earlier one.

    Args:
        samples: Stamps of at least one sample, sorted, (M,) nanoseconds.
        times: (N,) nanoseconds, in any order.
        method: How to choose.
        tolerance: The maximum distance of a sample; None: 0 for ``"match"``, otherwise no limit.
        max_gap: The maximum interval for interpolation; None: no limit.
    """
    before = np.searchsorted(samples, times, side="right") - 1  # -1: there is none
    earlier = np.maximum(before, 0)
    is_equal = (before >= 0) & (samples[earlier] == times)
    # The last one of those with the next stamp.
    later = np.minimum(before + 1, len(samples) - 1)
    later = np.searchsorted(samples, samples[later], side="right") - 1
    to_later = np.where(samples[later] >= times, samples[later] - times, _MAX_STAMP)
    to_earlier = np.where(before >= 0, times - samples[earlier], _MAX_STAMP)
    nearest = np.where(to_later < to_earlier, later, earlier)
    if method == "interpolate":
        return _interpolation_picks(
            samples, times, np.where(is_equal, earlier, later), earlier, nearest, tolerance, max_gap
        )
    chosen = earlier if method == "previous" else nearest
    age = times - samples[chosen]
    limit = 0 if method == "match" and tolerance is None else tolerance
    valid = np.ones(len(times), bool) if limit is None else np.abs(age) <= limit
    if method == "previous":
        valid &= before >= 0
    return MatchedRows(chosen, chosen, np.zeros(len(times)), valid, age, np.zeros(len(times), np.int64))


def _interpolation_picks(
    samples: NDArray[np.int64],
    times: NDArray[np.int64],
    second: NDArray[np.intp],
    first: NDArray[np.intp],
    nearest: NDArray[np.intp],
    tolerance: int | None,
    max_gap: int | None,
) -> MatchedRows:
    gap = samples[second] - samples[first]
    valid = (samples[first] <= times) & (times <= samples[second])
    share = np.divide(times - samples[first], gap, out=np.zeros(len(times)), where=gap > 0)
    age = times - samples[nearest]
    if tolerance is not None:
        valid &= np.abs(age) <= tolerance
    if max_gap is not None:
        valid &= gap <= max_gap
    return MatchedRows(first, second, np.clip(share, 0.0, 1.0), valid, age, np.where(valid, gap, 0))
