# SPDX-License-Identifier: Apache-2.0
"""The constant transform between two frames of one rigid body, and their time offset, from two trajectories.

Both trajectories show the motions of one body: ``a`` in the body's frame, ``b`` in the sensor's frame, with a X = X b
for the pose X of the sensor in the body. A hand-eye calibration is the same equation.

Motions between pairs of times are compared, not absolute poses, because odometry drifts. The times are random: a grid
that is aligned with the samples of one trajectory would bias the time offset, because interpolation smooths noise least
at the samples. A direction of the translation is shown only by rotations that move it: where these are no larger than
the noise, as the height of a robot that drives on a plane, it is not observable, and its value is that of a prior.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe import quaternion
from coframe._process.optional_imports import import_optional
from coframe.buffer.gaps import MAX_GAP, MAX_GAP_PERIODS
from coframe.errors import CalibrationError, TrajectoryError
from coframe.time import SECOND
from coframe.trajectories.motion_offset import motion_offset
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["RigidCalibration", "calibrate_hand_eye", "calibrate_rigid"]

MAX_PAIRS = 1000
MIN_PAIRS = 20
_WINDOWS = (0.4, 3.0)  # seconds between the two times of a pair
_MAX_SAMPLES_OF_PAIRS = 40  # pairs are tried for each that is wanted
_START_ANGLES = 36  # rotations about the usual axis from which the best one starts
_MIN_EXCITATION = 4.0  # ratio of the motion of a direction to the noise, below which it is not observable
_MIN_MOTION = np.radians(0.3)
_MAX_ROTATION_DEVIATION = np.radians(3.0)  # of an observable rotation
_MAD_TO_DEVIATION = 1.4826
_PRIOR_DEVIATION = 1.0  # meters
_BLOCK_DURATION = 2.0 * _WINDOWS[1]  # seconds
_POSES_PER_PAIR = 3.0  # The noise of a pose is in all pairs that begin or end next to it.


@dataclass(frozen=True, eq=False)
class RigidCalibration:
    """The pose of a sensor on a body.

    Attributes:
        transform: The pose of the sensor in the body, with its covariance; along hidden directions, 1 m.
        reference: The pose of the second trajectory's root in the root of the first one: of the map in the world.
        time_offset: Seconds to add to the stamps of the second trajectory.
        time_deviation: Its standard deviation in seconds, or NaN if the offset was given or is not observable.
        hidden: Unit vectors (N, 3) in the body along which the motion does not show the position.
        is_rotation_observable: Whether the motion shows the rotation in all directions.
        stamps: (M,) times of the residuals in nanoseconds.
        rotation_residuals: (M,) angles in radians by which the motions of a pair differ.
        translation_residuals: (M,) distances in meters by which the motions of a pair differ.
    """

    transform: Transform
    reference: Transform
    time_offset: float
    time_deviation: float
    hidden: Array
    is_rotation_observable: bool
    stamps: NDArray[np.int64]
    rotation_residuals: Array
    translation_residuals: Array

    @property
    def deviations(self) -> Array:
        """Standard deviations of x, y, z in meters and of the rotations about x, y, z in radians, shape (6,)."""
        return np.asarray(np.sqrt(np.diag(np.asarray(self.transform.covariance))))


class _Track:
    """A trajectory that can be evaluated at any time between its samples."""

    def __init__(self, poses: Transform, name: str) -> None:
        if poses.stamps is None or poses.shape[:1] < (MIN_PAIRS,):
            raise CalibrationError(f"{name} needs at least {MIN_PAIRS} poses with stamps, and has {len(poses)}")
        stamps, first = np.unique(np.asarray(poses.stamps, np.int64), return_index=True)
        self.stamps = stamps
        self.place = np.asarray(poses.translation)[first]
        self.turn = np.asarray(poses.quaternion)[first]
        self._vectors = quaternion.to_rotvec(quaternion.multiply(quaternion.inverse(self.turn[:-1]), self.turn[1:]))
        steps = np.diff(stamps)
        self._gaps = np.concatenate([[0], np.cumsum(steps > max(MAX_GAP, MAX_GAP_PERIODS * float(np.median(steps))))])

    def at(self, times: Array, origin: int) -> tuple[Array, Array]:
        """Return rotations and positions at times in seconds after an origin."""
        own = (self.stamps - origin) / SECOND
        row = np.clip(np.searchsorted(own, times, side="right") - 1, 0, len(own) - 2)
        share = ((times - own[row]) / (own[row + 1] - own[row]))[:, None]
        rotation = quaternion.multiply(self.turn[row], quaternion.from_rotvec(self._vectors[row] * share))
        return rotation, self.place[row] * (1.0 - share) + self.place[row + 1] * share

    def covers(self, start: Array, end: Array, origin: int) -> NDArray[np.bool_]:
        """Return which intervals are inside the trajectory and without gaps."""
        own = (self.stamps - origin) / SECOND
        inside = (start > own[0]) & (end < own[-1])
        rows = [np.clip(np.searchsorted(own, at) + k, 0, len(own) - 1) for at, k in ((start, -1), (end, 0))]
        return np.asarray(inside & (self._gaps[rows[0]] == self._gaps[rows[1]]))

    def motions(self, start: Array, end: Array, origin: int) -> _Motions:
        """Return the motions of the frame between pairs of times, in the frame at the first one."""
        (rotation, place), (later, there) = self.at(start, origin), self.at(end, origin)
        back = quaternion.inverse(rotation)
        return _Motions(quaternion.multiply(back, later), quaternion.rotate(back, there - place))


class _Motions(NamedTuple):
    turn: Array
    place: Array


def calibrate_rigid(
    first: Transform, second: Transform, *, prior: Transform | None = None, time_offset: float | None = None
) -> RigidCalibration:
    """Return the pose of one frame of a body in another one, from a trajectory of each.

    Args:
        first: Poses of the body in any fixed root, (N,) with stamps: ``recording.trajectory("odom:base_link")``.
        second: Poses of the sensor in another root, (M,) with stamps.
        prior: The pose of the sensor in the body as far as it is known, for directions that the motion does not show;
            by default 0.
        time_offset: Seconds to add to the stamps of the second trajectory; None: estimate it.

    Raises:
        CalibrationError: There are too few common motions.
        ModuleNotFoundError: SciPy is missing.

    Example:
        >>> time = np.arange(400) / 20
        >>> angles = np.stack([np.sin(time), np.cos(1.3 * time), np.sin(0.7 * time)], axis=1)
        >>> body = Transform.from_rpy(angles[:, ::-1], angles, stamp=(time * SECOND).astype(int))
        >>> mount = Transform.from_rpy([0.1, 0.2, 0.3], [0.0, 0.0, 1.5])
        >>> found = calibrate_rigid(body, body @ mount, time_offset=0.0)
        >>> found.transform.is_close(mount, translation=0.01, rotation=0.01)
        True
    """
    first_track, second_track = _Track(first, "the first trajectory"), _Track(second, "the second trajectory")
    origin = int(first_track.stamps[0])
    start_offset = _start_offset(first_track, second_track) if time_offset is None else time_offset
    begin, end = _pairs(first_track, second_track, origin, start_offset or 0.0)
    problem = _Problem(first_track, second_track, origin, begin, end, prior or Transform())
    return problem.solved(start_offset or 0.0, free_offset=time_offset is None)


def calibrate_hand_eye(
    gripper: Transform,
    tag: Transform,
    *,
    on_base: bool = False,
    prior: Transform | None = None,
    time_offset: float | None = None,
) -> RigidCalibration:
    """Return the pose of a camera on a gripper, from poses of the gripper and of a tag that does not move.

    Args:
        gripper: Poses of the gripper in the base of the robot, (N,) with stamps.
        tag: Poses of the tag in the camera, (M,) with stamps.
        on_base: Whether the camera is fixed next to the robot and the tag is on the gripper. Then ``transform`` is the
            pose of the tag in the gripper, and ``reference`` that of the camera in the base.
        prior: As in :func:`calibrate_rigid`.
        time_offset: As in :func:`calibrate_rigid`.

    Raises:
        CalibrationError: There are too few common motions.
        ModuleNotFoundError: SciPy is missing.
    """
    seen = tag if on_base else tag.inverse()
    return calibrate_rigid(gripper, seen.replace(target=None, source=None), prior=prior, time_offset=time_offset)


def _start_offset(first: _Track, second: _Track) -> float | None:
    """Return the time offset by the rates of rotation in seconds, or None if the motion does not show it."""
    try:
        return motion_offset((first.stamps, first.turn), (second.stamps, second.turn)).offset / SECOND
    except TrajectoryError:
        return None


def _pairs(first: _Track, second: _Track, origin: int, offset: float) -> tuple[Array, Array]:
    """Return random pairs of times, in seconds, between which both trajectories have no gap."""
    random = np.random.default_rng(0)
    span = max(float(first.stamps[-1] - origin) / SECOND, 1e-9)
    pair_count = int(np.clip(min(len(first.stamps), len(second.stamps)), MIN_PAIRS, MAX_PAIRS))
    begin = random.uniform(0.0, span, pair_count * _MAX_SAMPLES_OF_PAIRS)
    end = begin + random.uniform(*_WINDOWS, len(begin))
    margin = 0.1  # seconds by which the offset may change
    known = first.covers(begin, end, origin) & second.covers(begin - offset - margin, end - offset + margin, origin)
    if np.count_nonzero(known) < MIN_PAIRS:
        raise CalibrationError(
            f"the trajectories have only {np.count_nonzero(known)} common motions without gaps; {MIN_PAIRS} are needed",
            hint="Record both at the same time, with at most 0.5 s between poses, and check the clocks.",
        )
    return begin[known][:pair_count], end[known][:pair_count]


class _Problem:
    """The residuals of a X = X b over pairs of times, and their solution."""

    def __init__(self, first: _Track, second: _Track, origin: int, begin: Array, end: Array, prior: Transform) -> None:
        self._one, self._other, self._origin = first, second, origin
        self._begin, self._end = begin, end
        self._prior = prior
        self._body = first.motions(begin, end, origin)

    def _sensor(self, offset: float) -> _Motions:
        return self._other.motions(self._begin - offset, self._end - offset, self._origin)

    def residuals(self, mount_rotation: Array, place: Array, offset: float) -> tuple[Array, Array]:
        """Return the rotations and translations (N, 3) by which a X and X b differ."""
        body, sensor = self._body, self._sensor(offset)
        left = quaternion.multiply(body.turn, mount_rotation)
        right = quaternion.multiply(mount_rotation, sensor.turn)
        rotation = quaternion.to_rotvec(quaternion.multiply(quaternion.inverse(left), right))
        return rotation, quaternion.rotate(mount_rotation, sensor.place) + place - quaternion.rotate(
            body.turn, place
        ) - body.place

    def start(self, offset: float) -> tuple[Array, Array, Array]:
        """Return a rotation, a translation, and how much each direction of the translation is moved, (3, 3)."""
        body, sensor = self._body, self._sensor(offset)
        a, b = quaternion.to_rotvec(body.turn), quaternion.to_rotvec(sensor.turn)
        left, _, right = np.linalg.svd(a.T @ b)
        mount_rotation = quaternion.from_matrix(left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right)
        levers = quaternion.to_matrix(body.turn) - np.eye(3)
        axis = np.linalg.eigh(a.T @ a)[1][:, -1]
        best: tuple[float, Array, Array] = (np.inf, mount_rotation, np.zeros(3))
        for angle in np.arange(_START_ANGLES) * 2.0 * np.pi / _START_ANGLES:
            # Motions about one axis leave the rotation about it open, which the translations then show.
            candidate = quaternion.multiply(quaternion.from_rotvec(axis * angle), mount_rotation)
            aim = (quaternion.rotate(candidate, sensor.place) - body.place).reshape(-1)
            place = np.asarray(np.linalg.lstsq(levers.reshape(-1, 3), aim, rcond=0.02)[0], np.float64)
            rotation, translation = self.residuals(candidate, place, offset)
            size = float(np.mean(rotation**2) + np.mean(np.minimum(translation**2, 1.0)))
            if size < best[0]:
                best = (size, candidate, place)
        lever_products = np.einsum("nij,nik->jk", levers, levers) / len(levers)
        return best[1], best[2], lever_products

    def solved(self, offset: float, *, free_offset: bool) -> RigidCalibration:
        optimize = import_optional("scipy.optimize", "Calibration", "calibration")
        mount_rotation, place, moved = self.start(offset)
        rotation, _ = self.residuals(mount_rotation, place, offset)
        noise = _MAD_TO_DEVIATION * float(np.median(np.abs(rotation)))
        values, axes = np.linalg.eigh(moved)
        is_hidden = np.sqrt(np.maximum(values, 0.0)) < max(_MIN_EXCITATION * noise, _MIN_MOTION)
        hidden, shown = axes[:, is_hidden].T, axes[:, ~is_hidden]
        known = hidden.T @ (hidden @ self._prior.translation)
        place = known + shown @ (shown.T @ place)
        count = 3 + shown.shape[1] + int(free_offset)

        def apply(step: Array) -> tuple[Array, Array, float]:
            moved_place = known + shown @ (shown.T @ place + step[3 : 3 + shown.shape[1]])
            now = offset + (float(step[-1]) if free_offset else 0.0)
            return quaternion.multiply(mount_rotation, quaternion.from_rotvec(step[:3])), moved_place, now

        scales = np.array([1.0, 1.0])

        def weighted(step: Array) -> Array:
            r, t = self.residuals(*apply(step))
            return np.concatenate([r.ravel() / scales[0], t.ravel() / scales[1]])

        step = np.zeros(count)
        for _ in range(3):
            r, t = self.residuals(*apply(step))
            scales = np.array([max(_MAD_TO_DEVIATION * float(np.median(np.abs(part))), 1e-9) for part in (r, t)])
            fit = optimize.least_squares(weighted, step, loss="huber", f_scale=2.5, x_scale="jac")
            step = fit.x
        information = fit.jac.T @ fit.jac
        covariance = np.linalg.pinv(information, hermitian=True) * self._inflation(fit, information)
        return self._result(apply(step), covariance, (hidden, shown), free_offset=free_offset)

    def _inflation(self, fit: Any, information: Array) -> float:
        """Return by how much pairs that share noisy poses and drift make the covariance larger.

        The gradients of the pairs in blocks of time are summed, because the pairs of a block depend on each other
        (the sandwich estimator); the ratio to independent pairs is the mean over all parameters.
        """
        count = len(self._begin)
        rows = (fit.jac * fit.fun[:, None]).reshape(2, count, 3, -1).sum(axis=(0, 2))
        block = (self._begin // _BLOCK_DURATION).astype(np.int64)
        sums = np.stack([rows[block == number].sum(axis=0) for number in np.unique(block)])
        blocks = len(sums)
        ratio = float(np.trace(np.linalg.pinv(information, hermitian=True) @ sums.T @ sums)) / len(fit.x)
        inside = min(len(self._one.stamps), len(self._other.stamps))
        return max(1.0, _POSES_PER_PAIR * count / inside, ratio * blocks / max(blocks - 1, 1))

    def _result(
        self,
        solution: tuple[Array, Array, float],
        covariance: Array,
        directions: tuple[Array, Array],
        *,
        free_offset: bool,
    ) -> RigidCalibration:
        mount_rotation, place, offset = solution
        hidden, shown = directions
        size = shown.shape[1]
        # The steps of the rotation are in the sensor's axes; a covariance of ROS is in those of the body.
        jacobian = np.zeros((6, 3 + size))
        jacobian[3:, :3] = quaternion.to_matrix(mount_rotation)
        jacobian[:3, 3:] = shown
        whole = jacobian @ covariance[: 3 + size, : 3 + size] @ jacobian.T
        whole[:3, :3] += _PRIOR_DEVIATION**2 * hidden.T @ hidden
        rotation, translation = self.residuals(mount_rotation, place, offset)
        deviation = float(np.sqrt(covariance[-1, -1])) if free_offset else float("nan")
        is_shown = bool(np.sqrt(np.linalg.eigvalsh(whole[3:, 3:])[-1]) < _MAX_ROTATION_DEVIATION)
        return RigidCalibration(
            Transform(place, mount_rotation, covariance=(whole + whole.T) / 2.0),
            self._reference(mount_rotation, place, offset),
            offset,
            deviation,
            hidden,
            is_shown,
            self._origin + np.rint(self._begin * SECOND).astype(np.int64),
            np.linalg.norm(rotation, axis=1),
            np.linalg.norm(translation, axis=1),
        )

    def _reference(self, rotation: Array, place: Array, offset: float) -> Transform:
        """Return the mean pose of the second root in the first one."""
        a, x = Transform(*self._one.at(self._begin, self._origin)[::-1]), Transform(place, rotation)
        b = Transform(*self._other.at(self._begin - offset, self._origin)[::-1])
        each = a @ x @ b.inverse()
        rotations = np.asarray(each.quaternion)
        mean = np.linalg.eigh(rotations.T @ rotations)[1][:, -1]
        return Transform(np.median(np.asarray(each.translation), axis=0), mean)
