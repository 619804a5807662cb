"""As few poses of a motion as keep the steps between them short."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from coframe import quaternion

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.transform import Transform

Stamps = NDArray[np.int64]

# A step is cut into parts of equal time, of which some may still be too long: so often is it tried again.
_ROUNDS = 30
# Poses to choose from, a step: the more, the nearer to the limits the chosen steps come.
_CHOICE = 4


@dataclass(frozen=True)
class StepLimits:
    """How far two poses in a row may be apart.

    Attributes:
        max_translation: Metres; None: any.
        max_rotation: Radians; None: any.
    """

    max_translation: float | None
    max_rotation: float | None

    def __post_init__(self) -> None:
        for name, limit in (("max_translation", self.max_translation), ("max_rotation", self.max_rotation)):
            if limit is not None and not limit > 0:
                raise ValueError(f"{name} must be positive, not {limit}")

    def resample(self, poses_at: Callable[[Stamps], Transform], stamps: Stamps) -> Transform:
        """Poses from the first stamp to the last.

        Args:
            poses_at: Gives the poses at stamps.
            stamps: (N,) in order; those of the samples, between which the motion is smooth.
        """
        poses = poses_at(stamps)
        parts_a_step = _CHOICE
        for _ in range(_ROUNDS):
            parts = np.ceil(self._share(poses[:-1], poses[1:]) * parts_a_step).astype(np.int64)
            parts = np.clip(parts, 1, np.maximum(np.diff(stamps), 1))
            if (parts == 1).all():
                break
            stamps = _cut(stamps, parts)
            poses = poses_at(stamps)
            parts_a_step = 1
        return poses[self._thin(poses)]

    def _thin(self, poses: Transform) -> NDArray[np.intp]:
        """The indices of poses to keep: each next one is the last that is near enough."""
        kept = [0]
        last = len(poses) - 1
        while kept[-1] < last:
            start = kept[-1]
            # In growing pieces, as most steps are short and some are very long.
            width = 8
            while True:
                end = min(start + width, last)
                far = self._share(poses[start : start + 1], poses[start + 1 : end + 1]) > 1.0
                if far.any() or end == last:
                    break
                width *= 2
            kept.append(max(start + int(far.argmax()), start + 1) if far.any() else last)
        return np.array(kept, dtype=np.intp)

    def _share(self, a: Transform, b: Transform) -> NDArray[np.float64]:
        """How much of the limit each step takes."""
        share = np.zeros(len(b))
        if self.max_translation is not None:
            distance = np.linalg.norm(b.translation - a.translation, axis=-1)
            share = np.maximum(share, distance / self.max_translation)
        if self.max_rotation is not None:
            turn = quaternion.multiply(quaternion.inverse(a.quaternion), b.quaternion)
            angle = 2.0 * np.arctan2(np.linalg.norm(turn[..., :3], axis=-1), np.abs(turn[..., 3]))
            share = np.maximum(share, angle / self.max_rotation)
        return share


def _cut(stamps: Stamps, parts: Stamps) -> Stamps:
    """Each interval cut into so many of equal length."""
    start = np.repeat(stamps[:-1], parts)
    width = np.repeat(np.diff(stamps), parts)
    number = np.arange(len(start)) - np.repeat(np.cumsum(parts) - parts, parts)
    return np.append(start + width * number // np.repeat(parts, parts), stamps[-1])
