# SPDX-License-Identifier: Apache-2.0
"""Resample a motion with as few poses as the limits on the steps between them allow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import coframe.lazy_numpy as np
from coframe import quaternion

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from coframe.transform.transform import Transform

Stamps: TypeAlias = "NDArray[np.int64]"

# Steps are divided into parts of equal time. Parts that are still too long are divided again, at most this many times.
_MAX_ROUNDS = 30
# Candidate poses per step. More candidates bring the chosen steps closer to the limits.
_CANDIDATES = 4


@dataclass(frozen=True)
class StepLimits:
    """Maximum step between two successive poses.

    Attributes:
        max_translation: Distance in meters, or None for no limit.
        max_rotation: Angle in radians, or None for no limit.

    Raises:
        ValueError: A limit is not positive.
    """

    max_translation: float | None
    max_rotation: float | None

    def __post_init__(self) -> None:
        for name, limit in (("max_translation", self.max_translation), ("max_rotation", self.max_rotation)):
            if limit is not None and not limit > 0:
                raise ValueError(f"{name} must be positive, not {limit}")

    def resample(self, poses_at: Callable[[Stamps], Transform], stamps: Stamps) -> Transform:
        """Return poses from the first stamp to the last, with steps within the limits.

        Args:
            poses_at: Returns the batch of poses at given stamps.
            stamps: Stamps of the samples, shape (N,), sorted. Between two of them the motion is smooth.
        """
        poses = poses_at(stamps)
        parts_per_step = _CANDIDATES
        for _ in range(_MAX_ROUNDS):
            parts = np.ceil(self._step_fractions(poses[:-1], poses[1:]) * parts_per_step).astype(np.int64)
            parts = np.clip(parts, 1, np.maximum(np.diff(stamps), 1))
            if (parts == 1).all():
                break
            stamps = _divide(stamps, parts)
            poses = poses_at(stamps)
            parts_per_step = 1
        return poses[self._thin_rows(poses)]

    def _thin_rows(self, poses: Transform) -> NDArray[np.intp]:
        """Return the indices of the poses to keep. Each one is the last pose within the limits of the previous one."""
        kept = [0]
        last = len(poses) - 1
        while kept[-1] < last:
            start = kept[-1]
            # Search in growing intervals: most steps are short, and some are very long.
            width = 8
            while True:
                end = min(start + width, last)
                far = self._step_fractions(poses[start : start + 1], poses[start + 1 : end + 1]) > 1.0
                if far.any() or end == last:
                    break
                width *= 2
            kept.append(max(start + int(far.argmax()), start + 1) if far.any() else last)
        return np.array(kept, dtype=np.intp)

    def _step_fractions(self, a: Transform, b: Transform) -> NDArray[np.float64]:
        """Return the size of each step as a fraction of the limit."""
        share = np.zeros(len(b))
        if self.max_translation is not None:
            distance = np.linalg.norm(b.translation - a.translation, axis=-1)
            share = np.maximum(share, distance / self.max_translation)
        if self.max_rotation is not None:
            rotation_difference = quaternion.multiply(quaternion.inverse(a.quaternion), b.quaternion)
            angle = 2.0 * np.arctan2(
                np.linalg.norm(rotation_difference[..., :3], axis=-1), np.abs(rotation_difference[..., 3])
            )
            share = np.maximum(share, angle / self.max_rotation)
        return share


def _divide(stamps: Stamps, parts: Stamps) -> Stamps:
    """Divide each interval between two stamps into the given number of equal parts."""
    start = np.repeat(stamps[:-1], parts)
    width = np.repeat(np.diff(stamps), parts)
    number = np.arange(len(start)) - np.repeat(np.cumsum(parts) - parts, parts)
    return np.append(start + width * number // np.repeat(parts, parts), stamps[-1])
