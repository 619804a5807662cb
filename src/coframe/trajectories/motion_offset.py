# SPDX-License-Identifier: Apache-2.0
"""The time offset of two trajectories of one rigid body, from its rate of rotation.

The angle by which a rigid body turns during a time is the same for every frame that is fixed to it, and relative to
every frame that does not turn. So neither the mount between the two sensors nor their map frames need to be known.

The correlation of the two rates of rotation gives a first offset. Then the angles during short times are compared, and
offset and drift are found by least squares (Gauss-Newton). The times are random: a grid that is aligned with the
samples of one trajectory would bias the offset by a part of its period.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import quaternion
from coframe._output.formatting import duration
from coframe.errors import TrajectoryError
from coframe.time import MILLISECOND, SECOND

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["MotionOffset", "motion_offset"]

_GRID_STEP = 0.05  # seconds, of the grid for the first offset
_MIN_OVERLAP = 10.0  # seconds
_MAX_CELLS = 1 << 23  # of the grid: 116 hours
_WINDOWS = (0.4, 1.0, 2.5)  # seconds in which the body turns by the angles that are compared
_WINDOWS_PER_LENGTH = 8  # random times per window that would fit next to each other
_MIN_TIMES, _MAX_TIMES = 50, 5000
_MAX_GAP = 0.5  # seconds without samples, in which no angle is taken
_MIN_CORRELATION = 0.5
_MAX_SECOND_PEAK = 0.9  # of the highest correlation, at another offset
_PEAK_WIDTH = 2.0  # seconds on both sides of the highest correlation that belong to it
_MAX_DEVIATION = 10 * MILLISECOND
_ITERATIONS = 15
_CONVERGENCE_TOLERANCE = 1e-5  # seconds
_HUBER_LIMIT = 2.5  # robust standard deviations up to which residuals count fully
_MAD_TO_DEVIATION = (
    1.4826  # The standard deviation of a normal distribution is this multiple of its median absolute deviation.
)
_MIN_SIGNIFICANCE = 4.0  # standard deviations of a drift


class MotionOffset(NamedTuple):
    """The offset to add to the times of the second trajectory.

    Attributes:
        offset: The offset in nanoseconds in the middle of the common time.
        deviation: Its standard deviation in nanoseconds.
        drift: The change of the offset in seconds per second, or 0 if it is not significant.
        middle: The middle of the common time, in nanoseconds on the clock of the first trajectory.
        correlation: The correlation of the two rates of rotation at this offset, up to 1.
    """

    offset: int
    deviation: int
    drift: float
    middle: int
    correlation: float

    def __str__(self) -> str:
        drift = f", drift {self.drift * 1e6:.3g} ppm" if self.drift else ""
        return f"{self.offset / SECOND:+.4f} s +-{duration(self.deviation)}{drift}"


class _Fit(NamedTuple):
    """Offset, drift, their standard deviations, and the middle of the common time, all in seconds."""

    offset: float
    drift: float
    deviation: float
    drift_deviation: float
    middle: float


class _Rotations:
    """The rotations of one trajectory over time, with times in seconds from an origin."""

    def __init__(self, stamps: NDArray[np.int64], rotations: NDArray[np.float64]) -> None:
        order = np.argsort(stamps, kind="stable")
        stamps, rotations = stamps[order], rotations[order]
        is_new = np.concatenate([[True], np.diff(stamps) > 0])
        finite = np.isfinite(rotations).all(axis=1)
        stamps, rotations = stamps[is_new & finite], rotations[is_new & finite]
        if len(stamps) < 3:
            raise TrajectoryError("a time offset needs trajectories with at least three poses")
        self.origin = int(stamps[0])
        self.times = (stamps - self.origin) / SECOND
        self._rotations = rotations / np.linalg.norm(rotations, axis=1, keepdims=True)
        turns = quaternion.multiply(quaternion.inverse(self._rotations[:-1]), self._rotations[1:])
        self._vectors = quaternion.to_rotvec(turns)
        self._gaps = np.diff(self.times) > _MAX_GAP

    @property
    def duration(self) -> float:
        return float(self.times[-1])

    def poses_between(self, times: NDArray[np.float64]) -> int:
        """Return the number of poses between the first and the last of some sorted times."""
        first, last = np.searchsorted(self.times, [times[0], times[-1]])
        return int(last - first)

    def on_grid(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the angles after the times of a grid, and 1 where they are known, otherwise 0."""
        times = np.arange(0.0, self.duration, _GRID_STEP)
        known = self.covers(times, _WINDOWS[0])
        angles = np.zeros(len(times))
        angles[known] = self.angles(times[known], _WINDOWS[0])
        return angles, known.astype(np.float64)

    def at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the interpolated rotations."""
        number = np.clip(np.searchsorted(self.times, times, side="right") - 1, 0, len(self._vectors) - 1)
        share = (times - self.times[number]) / (self.times[number + 1] - self.times[number])
        part = quaternion.from_rotvec(self._vectors[number] * share[:, None])
        return quaternion.multiply(self._rotations[number], part)

    def covers(self, times: NDArray[np.float64], window: float) -> NDArray[np.bool_]:
        """Return where the window after a time is inside the trajectory and without a gap."""
        end = times + window
        inside = (times >= 0.0) & (end <= self.duration)
        before = np.concatenate([[0], np.cumsum(self._gaps)])
        first = np.clip(np.searchsorted(self.times, times, side="right") - 1, 0, len(self._gaps))
        last = np.clip(np.searchsorted(self.times, end, side="left"), 0, len(self._gaps))
        return np.asarray(inside & (before[last] == before[first]))

    def angles(self, times: NDArray[np.float64], window: float) -> NDArray[np.float64]:
        """Return the angle by which the body turns in the window after each time, in radians."""
        turns = quaternion.multiply(quaternion.inverse(self.at(times)), self.at(times + window))
        return np.asarray(np.linalg.norm(quaternion.to_rotvec(turns), axis=1))


def motion_offset(
    first: tuple[NDArray[np.int64], NDArray[np.float64]],
    second: tuple[NDArray[np.int64], NDArray[np.float64]],
) -> MotionOffset:
    """Return the offset to add to the times of the second trajectory so that both show the same motion.

    Args:
        first: (N,) times in nanoseconds and (N, 4) quaternions (x, y, z, w) of a frame of the body.
        second: The same of another frame of the body, (M,) and (M, 4), on another clock.

    Raises:
        TrajectoryError: There is too little common motion for a standard deviation below 10 ms, or the motion repeats
            itself, so that several offsets fit.
    """
    one, other = _Rotations(*first), _Rotations(*second)
    rough, correlation = _rough_offset(one, other)
    fit = _refine_fit(one, other, rough)
    deviation = fit.deviation * SECOND
    if not deviation <= _MAX_DEVIATION:
        raise TrajectoryError(
            f"the common rotation is too small for a time offset: its standard deviation would be "
            f"{duration(deviation)}, and {duration(_MAX_DEVIATION)} is the limit",
            hint="Record a motion with turns about any axis, at least 20 degrees, several times.",
        )
    nanoseconds = one.origin - other.origin + round(fit.offset * SECOND)
    middle = one.origin + round(fit.middle * SECOND)
    return MotionOffset(nanoseconds, round(deviation), fit.drift, middle, correlation)


def _rough_offset(one: _Rotations, other: _Rotations) -> tuple[float, float]:
    """Return the offset with the highest correlation, in seconds to add to the other, and the correlation."""
    cells = int(np.ceil((one.duration + other.duration) / _GRID_STEP)) + 2
    if cells > _MAX_CELLS:
        raise TrajectoryError("the trajectories are longer than 116 hours; cut them first")
    size = 1 << (cells - 1).bit_length()
    (a, known_a), (b, known_b) = one.on_grid(), other.on_grid()
    a, b = (a - _mean(a, known_a)) * known_a, (b - _mean(b, known_b)) * known_b
    overlap = _correlate(known_a, known_b, size) * _GRID_STEP
    energy = _correlate(a * a, known_b, size) * _correlate(known_a, b * b, size)
    enough = overlap >= min(_MIN_OVERLAP, 0.5 * min(one.duration, other.duration))
    floor = 1e-6 * float(np.sum(a * a)) * float(np.sum(b * b))
    values = np.where(enough & (energy > floor), _correlate(a, b, size) / np.sqrt(np.maximum(energy, 1e-300)), -1.0)
    best = int(values.argmax())
    cells_later = np.arange(size)
    lags = np.where(cells_later < len(a), cells_later, cells_later - size) * _GRID_STEP
    peak = float(values[best])
    distances = np.abs(lags - lags[best])
    elsewhere = float(values[distances > _PEAK_WIDTH].max(initial=-1.0))
    if peak < _MIN_CORRELATION:
        raise TrajectoryError(
            f"the rotations do not agree at any time offset: the correlation is at most {max(peak, 0.0):.2f}",
            hint="Both trajectories must be of frames that are fixed to one body, and the body must turn.",
        )
    if elsewhere > _MAX_SECOND_PEAK * peak:
        other_lag = float(lags[distances > _PEAK_WIDTH][values[distances > _PEAK_WIDTH].argmax()])
        raise TrajectoryError(
            f"the motion repeats itself: time offsets that differ by {abs(other_lag - lags[best]):.1f} s fit "
            f"(correlations {peak:.2f} and {elsewhere:.2f})",
            hint="Record a motion that does not repeat itself, such as turns of different size.",
        )
    return float(lags[best]), peak


def _correlate(a: NDArray[np.float64], b: NDArray[np.float64], size: int) -> NDArray[np.float64]:
    """Return the sum of products of two signals for each shift of the second one, modulo `size`."""
    return np.asarray(np.fft.irfft(np.fft.rfft(a, size) * np.conj(np.fft.rfft(b, size)), size))


def _mean(values: NDArray[np.float64], known: NDArray[np.float64]) -> float:
    return float((values * known).sum() / max(known.sum(), 1.0))


def _refine_fit(one: _Rotations, other: _Rotations, rough: float) -> _Fit:
    """Return the most precise fit of several windows: noise needs longer ones, quick motion needs shorter ones."""
    fits = [_fit_window(one, other, rough, window) for window in _WINDOWS]
    return min(fits, key=lambda fit: fit.deviation)


def _fit_window(one: _Rotations, other: _Rotations, rough: float, window: float) -> _Fit:
    begin, end = max(0.0, rough), min(one.duration, other.duration + rough) - window
    count = int(np.clip((end - begin) / window * _WINDOWS_PER_LENGTH, _MIN_TIMES, _MAX_TIMES))
    times = np.sort(np.random.default_rng(0).uniform(begin, max(end, begin), count))
    times = times[one.covers(times, window)]
    middle = 0.5 * (begin + end)
    fit = _fit(one, other, times, window, _Fit(rough, 0.0, np.inf, np.inf, middle), free=2)
    if abs(fit.drift) <= _MIN_SIGNIFICANCE * fit.drift_deviation:
        fit = _fit(one, other, times, window, _Fit(rough, 0.0, np.inf, np.inf, middle), free=1)
    return fit


def _fit(
    one: _Rotations, other: _Rotations, times: NDArray[np.float64], window: float, fit: _Fit, *, free: int
) -> _Fit:
    """Improve a fit: the offset, and with two free parameters also the drift.

    The angle of the first trajectory after a time is equal to that of the second one after the shifted time, plus a
    constant, because noise makes angles larger. The slopes of the second one contain noise, which would make the steps
    too small and the standard deviations wrong; so those of the first one, whose noise is independent, are the
    instrument (instrumental variables).
    """
    step = window / 4
    for _ in range(_ITERATIONS):
        since = times - fit.middle
        shifted = times - fit.offset - fit.drift * since
        used = np.logical_and.reduce([
            each.covers(at, window)
            for each, center in ((one, times), (other, shifted))
            for at in (center - step, center + step)
        ])  # fmt: skip
        if np.count_nonzero(used) < _MIN_TIMES // 2:
            return fit
        now, at, since = times[used], shifted[used], since[used]
        slopes, instruments = (_fit_slopes(each, center, step, window) for each, center in ((other, at), (one, now)))
        columns = [*range(free), 2]
        matrix = np.stack([slopes, slopes * since, np.ones(len(at))], axis=1)[:, columns]
        instrument = np.stack([instruments, instruments * since, np.ones(len(at))], axis=1)[:, columns]
        residual = one.angles(now, window) - other.angles(at, window)
        change, covariance = _robust_step(matrix, instrument, residual)
        # The noise of a pose is in all windows that begin or end next to it.
        independent = max(min(len(at), one.poses_between(now) / 3, other.poses_between(at) / 3), 1.0)
        deviations = np.sqrt(np.maximum(np.diag(covariance), 0.0) * len(at) / independent)
        fit = _Fit(
            fit.offset + float(np.clip(change[0], -window, window)),
            fit.drift + float(change[1]) if free == 2 else 0.0,
            float(deviations[0]),
            float(deviations[1]) if free == 2 else np.inf,
            fit.middle,
        )
        if abs(change[0]) < _CONVERGENCE_TOLERANCE:
            break
    return fit


def _fit_slopes(one: _Rotations, times: NDArray[np.float64], step: float, window: float) -> NDArray[np.float64]:
    """Return by how much the angles after some times change per second of offset."""
    return np.asarray((one.angles(times - step, window) - one.angles(times + step, window)) / (2 * step))


def _robust_step(
    matrix: NDArray[np.float64], instrument: NDArray[np.float64], residual: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the change of the parameters with Huber's weights, and their covariance for independent residuals."""
    centered = residual - np.median(residual)
    spread = max(_MAD_TO_DEVIATION * float(np.median(np.abs(centered))), 1e-9)
    weights = np.minimum(1.0, _HUBER_LIMIT * spread / np.maximum(np.abs(centered), 1e-300))
    weighted = instrument * weights[:, None]
    inverse = np.linalg.pinv(weighted.T @ matrix)
    covariance = spread**2 * inverse @ (instrument.T @ instrument) @ inverse.T
    return inverse @ (weighted.T @ residual), covariance
