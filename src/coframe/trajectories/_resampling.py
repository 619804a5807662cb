# SPDX-License-Identifier: Apache-2.0
"""Poses of a trajectory at other times, without interpolating across gaps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.buffer.gaps import MAX_GAP_PERIODS
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["median_period", "resample"]


def resample(poses: Transform, stamps: NDArray[np.int64]) -> Transform:
    """Return poses at those of the stamps that are inside a trajectory and not in a gap of more than four periods.

    Args:
        poses: A batch with stamps.
        stamps: The times in nanoseconds, (M,).

    Returns:
        A batch with the usable stamps, in order; it may be empty.
    """
    known, rows = np.unique(np.asarray(poses.stamps, np.int64), return_index=True)
    at = np.unique(np.asarray(stamps, np.int64))
    if len(known) < 2:
        return poses[rows][np.isin(known, at)]
    after = np.searchsorted(known, at).clip(1, len(known) - 1)
    length = known[after] - known[after - 1]
    at_sample = (at == known[after]) | (at == known[after - 1])
    near = length <= MAX_GAP_PERIODS * median_period(poses)
    usable = (at >= known[0]) & (at <= known[-1]) & (near | at_sample)
    at, after, length = at[usable], after[usable], length[usable]
    share = (at - known[after - 1]) / length
    first, second = (Transform(poses.translation[i], poses.quaternion[i]) for i in (rows[after - 1], rows[after]))
    return first.interpolate(second, share).replace(target=poses.target, source=poses.source, stamp=at)


def median_period(poses: Transform) -> int:
    """Return the median time between two poses in nanoseconds, or 0 without stamps."""
    if poses.stamps is None or len(poses) < 2:
        return 0
    return int(np.median(np.abs(np.diff(poses.stamps))))
