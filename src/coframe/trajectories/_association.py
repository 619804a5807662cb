# SPDX-License-Identifier: Apache-2.0
"""Associate the poses of two trajectories by their stamps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import count, duration, seconds
from coframe.errors import TrajectoryError
from coframe.time import MILLISECOND, duration_ns

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.time import DurationLike
    from coframe.transform.transform import Transform

__all__ = ["MAX_DIFFERENCE", "associate"]

MAX_DIFFERENCE = 10 * MILLISECOND


def associate(
    reference: Transform, estimate: Transform, max_difference: DurationLike = MAX_DIFFERENCE
) -> tuple[Transform, Transform]:
    """Return the matching poses of two trajectories, as two batches of the same length.

    Each pose of the trajectory with fewer poses is paired with the pose of the other one whose stamp is nearest.
    Trajectories without stamps (KITTI) must have the same number of poses, which are paired in order.

    Args:
        reference: A batch of shape (N,).
        estimate: A batch of shape (M,).
        max_difference: The maximum difference between the stamps of a pair; poses without a match are dropped.

    Raises:
        TrajectoryError: There is no pair, or one trajectory has no stamps and the numbers of poses differ.
        ValueError: ``max_difference`` is negative.
    """
    limit = duration_ns(max_difference)
    if limit < 0:
        raise ValueError(f"max_difference must not be negative, not {limit} ns")
    if reference.stamps is None or estimate.stamps is None:
        if len(reference) != len(estimate):
            raise TrajectoryError(
                f"The reference has {count(len(reference), 'pose')} and the estimate has {len(estimate)}, and they "
                "cannot be paired by stamps because one of them has none",
                hint="Give both trajectories in a format with stamps, such as TUM or EuRoC.",
            )
        return reference, estimate
    is_estimate_longer = len(estimate) > len(reference)
    short, long = (reference.stamps, estimate.stamps) if is_estimate_longer else (estimate.stamps, reference.stamps)
    in_short, in_long = _nearest_pairs(short, long, limit)
    if not in_short.size:
        spans = [f"{seconds(int(s.min()))} to {seconds(int(s.max()))}" for s in (reference.stamps, estimate.stamps)]
        raise TrajectoryError(
            f"No stamps of the two trajectories are within {duration(limit)} of each other: the reference has stamps "
            f"from {spans[0]}, the estimate from {spans[1]}",
            hint="If both use the same clock, allow a larger difference. If both began at the same time, the time "
            f"offset of the estimate is {seconds(int(reference.stamps.min()) - int(estimate.stamps.min()))} s.",
        )
    if is_estimate_longer:
        return reference[in_short], estimate[in_long]
    return reference[in_long], estimate[in_short]


def _nearest_pairs(
    stamps: NDArray[np.int64], others: NDArray[np.int64], limit: int
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the indices of the pairs. If two stamps are equally near, the earlier one is used."""
    order = np.argsort(others, kind="stable")
    ordered = others[order]
    upper = np.minimum(np.searchsorted(ordered, stamps, side="right"), len(ordered) - 1)
    lower = np.maximum(upper - 1, 0)
    to_upper, to_lower = np.abs(ordered[upper] - stamps), np.abs(stamps - ordered[lower])
    nearest = np.where(to_upper < to_lower, upper, lower)
    pairs = np.flatnonzero(np.minimum(to_upper, to_lower) <= limit)
    return pairs, order[nearest[pairs]]
