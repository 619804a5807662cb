# SPDX-License-Identifier: Apache-2.0
"""Constant differences between two trajectories that look like errors: another frame on the body, another clock."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import quaternion
from coframe.buffer.gaps import MAX_GAP_PERIODS
from coframe.errors import TrajectoryError
from coframe.time import MILLISECOND, SECOND
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from coframe.trajectories._alignment import Alignment

    Align = Callable[[Transform, Transform], Alignment | None]

__all__ = ["BodyOffset", "TimeShift", "find_body_offset", "find_time_shift"]

MAX_SHIFT = 2 * SECOND
_MIN_PAIRS = 10
_MIN_ANGLE = np.radians(2.0)
_MIN_SHIFT = MILLISECOND
# An offset explains most of an error if it leaves less than this share of it.
_STEP_RATIO = 0.5
_MAX_ROUNDS = 30
_ROUNDS_PER_SHIFT = 4  # each begins with the offset of the shift before
_SEARCH_STEPS = 160  # of the search for a time shift
_RESOLUTION = 10_000  # nanoseconds
_SEARCHED_POSES = 400
_SMOOTHING_PERIODS = 4  # periods before and after a pose
_GOLDEN_RATIO = (5**0.5 - 1) / 2


class BodyOffset(NamedTuple):
    """A constant pose between the frame of the estimate and that of the reference, such as of a camera on a robot.

    Attributes:
        transform: The pose of the reference's frame relative to the frame of the estimate; ``estimate @ transform`` are
            the poses that compare with the reference.
        translation_rmse: The absolute translation error without it, in meters, (before, after).
        rotation_rmse: The absolute rotation error without it, in radians, (before, after).
    """

    transform: Transform
    translation_rmse: tuple[float, float]
    rotation_rmse: tuple[float, float]


class TimeShift(NamedTuple):
    """A constant difference between the clocks of two trajectories.

    Attributes:
        offset: What must be added to the stamps of the estimate, in nanoseconds.
        translation_rmse: The absolute translation error between interpolated poses in meters, (before, after).
    """

    offset: int
    translation_rmse: tuple[float, float]


def find_body_offset(
    reference: Transform, estimate: Transform, align: Align, *, always: bool = False
) -> BodyOffset | None:
    """Return the constant pose that explains most of the rotation error or most of the translation error.

    Args:
        reference: The paired poses of the reference, (N,).
        estimate: The paired poses of the estimate, (N,).
        align: Returns the alignment of an estimate with the reference, or None without one.
        always: Whether to return the best offset also if it explains less than half of the errors.

    Returns:
        The offset, or None if there is none, or if less than half of either error is explained by it.
    """
    if len(reference) < _MIN_PAIRS:
        return None
    offset = Transform()
    try:
        before = _align(reference, estimate, align)[0]
        for _ in range(_MAX_ROUNDS):
            poses, scale = _align(reference, estimate @ offset, align)
            step = _offset_step(reference, poses, scale)
            offset = offset @ step
            if float(np.abs(step.log()).max()) < 1e-12:
                break
        after = _align(reference, estimate @ offset, align)[0]
    except TrajectoryError:  # The positions do not determine an alignment.
        return None
    translations = _translation_rmse(reference, before), _translation_rmse(reference, after)
    rotations = _rotation_rmse(reference, before), _rotation_rmse(reference, after)
    angle = float(np.linalg.norm(quaternion.to_rotvec(offset.quaternion)))
    # Another world frame also turns all poses of a robot on a plane, but it moves them by the angle times the extent.
    extent = float(np.sqrt(reference.translation.var(axis=0).sum()))
    is_near = translations[1] < max(_STEP_RATIO * translations[0], _STEP_RATIO * 2.0 * np.sin(angle / 2.0) * extent)
    explains_rotation = angle > _MIN_ANGLE and rotations[1] < _STEP_RATIO * rotations[0] and is_near
    # A lever arm can only be distinguished from noise if it explains the translations, and nothing gets worse.
    explains_translation = translations[1] < _STEP_RATIO * translations[0] and rotations[1] < 1.01 * rotations[0] + 1e-9
    is_arm = float(np.linalg.norm(offset.translation)) > 3.0 * translations[1] + 1e-6
    if not (always or explains_rotation or (explains_translation and is_arm)):
        return None
    return BodyOffset(offset, translations, rotations)


def find_time_shift(
    reference: Transform, estimate: Transform, align: Align, *, with_offset: bool = False, always: bool = False
) -> TimeShift | None:
    """Return the time shift of at most `MAX_SHIFT` that explains most of the translation error.

    Args:
        reference: The trajectory of the reference, with or without stamps.
        estimate: The trajectory of the estimate, with or without stamps.
        align: As in :func:`find_body_offset`.
        with_offset: Whether the frames may also differ by a constant pose, which is computed for each shift: otherwise,
            a lever arm and a shift would each hide a part of the other one.
        always: Whether to return the best shift also if it explains less than half of the error.

    Returns:
        The shift, or None if none of at least a millisecond explains more than half of the error.
    """
    if reference.stamps is None or estimate.stamps is None or min(len(reference), len(estimate)) < _MIN_PAIRS:
        return None
    moving = _ShiftedPair(reference, estimate, align, with_offset=with_offset)
    if not moving.is_possible:
        return None
    steps = _SEARCH_STEPS // 2 if with_offset else _SEARCH_STEPS
    shifts = np.linspace(-moving.limit, moving.limit, steps + 1)
    best = shifts[int(np.argmin([moving.error(shift) for shift in shifts]))]
    low, high = best - 2 * moving.limit / steps, best + 2 * moving.limit / steps
    while high - low > _RESOLUTION:
        inner = high - _GOLDEN_RATIO * (high - low), low + _GOLDEN_RATIO * (high - low)
        if moving.error(inner[0]) <= moving.error(inner[1]):
            high = inner[1]
        else:
            low = inner[0]
    found = (low + high) / 2
    before, after = moving.error(0.0), moving.error(found)
    is_large = abs(found) >= _MIN_SHIFT and after < _STEP_RATIO * before
    if not is_large and not (always and after < before):
        return None
    return TimeShift(round(found), (before, after))


class _ShiftedPair:
    """The poses of two trajectories at common times, with the estimate shifted in time."""

    def __init__(self, reference: Transform, estimate: Transform, align: Align, *, with_offset: bool) -> None:
        order = [np.argsort(poses.stamps, kind="stable") for poses in (reference, estimate)]  # type: ignore[arg-type]
        reference, self._estimate = reference[order[0]], estimate[order[1]]
        self._alignment, self._with_offset = align, with_offset
        self._offset = Transform()
        times = np.asarray(reference.stamps, dtype=np.int64)
        self._times = np.asarray(self._estimate.stamps, dtype=np.int64)
        self._max_gap = MAX_GAP_PERIODS * _period(self._times)
        width = _SMOOTHING_PERIODS * max(_period(times), _period(self._times))
        self._positions = _smooth_positions(self._times, self._estimate.translation, width)
        positions = _smooth_positions(times, reference.translation, width)
        common = min(int(times[-1]), int(self._times[-1])) - max(int(times[0]), int(self._times[0]))
        self.limit = float(min(MAX_SHIFT, max(common, 0) // 4))
        first, last = self._times[0] + self.limit, self._times[-1] - self.limit
        inside = np.flatnonzero((times >= first) & (times <= last))
        most = _SEARCHED_POSES // 2 if with_offset else _SEARCHED_POSES
        inside = inside[:: max(1, -(-len(inside) // most))]
        self.is_possible = self.limit > _MIN_SHIFT and len(inside) >= _MIN_PAIRS
        self._reference = Transform(positions[inside], reference.quaternion[inside])
        self._at = times[inside]

    def error(self, shift: float) -> float:
        """Return the root mean square distance after adding a shift to the stamps of the estimate."""
        inside = self._is_between_near_samples(shift)
        if np.count_nonzero(inside) < max(_MIN_PAIRS, len(inside) // 4):
            return float("inf")
        poses, reference = self._poses(shift)[inside], self._reference[inside]
        try:
            for _ in range(_ROUNDS_PER_SHIFT if self._with_offset else 0):
                near, scale = _align(reference, poses @ self._offset, self._alignment)
                self._offset = self._offset @ _offset_step(reference, near, scale)
            near, _ = _align(reference, poses @ self._offset, self._alignment)
        except TrajectoryError:
            return float("inf")
        return _translation_rmse(reference, near)

    def _is_between_near_samples(self, shift: float) -> NDArray[np.bool_]:
        """Return at which times the estimate is not interpolated over a gap."""
        at = np.searchsorted(self._times, self._at - round(shift)).clip(1, len(self._times) - 1)
        return np.asarray(self._times[at] - self._times[at - 1] <= self._max_gap)

    def _poses(self, shift: float) -> Transform:
        """Return the poses of the estimate at the times of the reference."""
        at = (self._at - self._times[0]) - shift
        known = (self._times - self._times[0]).astype(np.float64)
        positions = np.stack([np.interp(at, known, self._positions[:, axis]) for axis in range(3)], axis=1)
        if not self._with_offset:
            return Transform(positions)
        after = np.clip(np.searchsorted(known, at), 1, len(known) - 1)
        before = after - 1
        length = known[after] - known[before]
        share = np.divide(at - known[before], length, out=np.zeros(len(at)), where=length > 0)
        origin = np.zeros((len(at), 3))
        first, second = (Transform(origin, self._estimate.quaternion[rows]) for rows in (before, after))
        return Transform(positions, first.interpolate(second, np.clip(share, 0.0, 1.0)).quaternion)


def _period(stamps: NDArray[np.int64]) -> float:
    return float(np.median(np.diff(stamps)))


def _smooth_positions(stamps: NDArray[np.int64], positions: NDArray[np.float64], width: float) -> NDArray[np.float64]:
    """Return positions with less noise; between two stamps, noise averages out, which would attract the search."""
    known = (stamps - stamps[0]).astype(np.float64)
    parts = [
        np.stack([np.interp(known + offset, known, positions[:, axis]) for axis in range(3)], axis=1)
        for offset in np.linspace(-width, width, 4 * _SMOOTHING_PERIODS + 1)
    ]
    return np.asarray(np.mean(parts, axis=0))


def _align(reference: Transform, estimate: Transform, align: Align) -> tuple[Transform, float]:
    alignment = align(reference, estimate)
    return (estimate, 1.0) if alignment is None else (alignment.apply(estimate), alignment.scale)


def _offset_step(reference: Transform, poses: Transform, scale: float) -> Transform:
    """Return the constant pose that brings the poses nearer to the reference."""
    turns = quaternion.multiply(quaternion.inverse(poses.quaternion), reference.quaternion)
    rotation = _mean_rotation(turns)
    matrices = quaternion.to_matrix(poses.quaternion)
    missing = reference.translation - poses.translation
    # The alignment takes away the mean, so only the changes of the lever arm tell it from a shift of the origin.
    matrices, missing = matrices - matrices.mean(axis=0), missing - missing.mean(axis=0)
    arm, *_ = np.linalg.lstsq(scale * matrices.reshape(-1, 3), missing.reshape(-1), rcond=1e-3)
    return Transform(arm, rotation)


def _mean_rotation(turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the quaternion with the least squared distance to others, of either sign (Markley et al., 2007)."""
    _, vectors = np.linalg.eigh(turns.T @ turns)
    return np.asarray(vectors[:, -1])


def _translation_rmse(reference: Transform, poses: Transform) -> float:
    return float(np.sqrt(((reference.translation - poses.translation) ** 2).sum(axis=1).mean()))


def _rotation_rmse(reference: Transform, poses: Transform) -> float:
    turns = quaternion.multiply(quaternion.inverse(poses.quaternion), reference.quaternion)
    angles = 2.0 * np.arctan2(np.linalg.norm(turns[:, :3], axis=1), np.abs(turns[:, 3]))
    return float(np.sqrt((angles**2).mean()))
