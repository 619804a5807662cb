# SPDX-License-Identifier: Apache-2.0
"""Compare the published motion of a joint with the specified motion, and find the mistake by trial.

A trial is a pair: a mistake in the formula of the quaternion, and a mistake in the time or in the formula of the angle.
It names the mistake only if all samples agree with it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.course.criteria.causes import quaternion_values
from coframe.course.criteria.common import stamp_ns, to_seconds
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from coframe.course._world import Received

    Array = NDArray[np.float64]

__all__ = ["ANGLE", "CHILDREN", "Formula", "JointSamples", "Motion", "angle_of", "specified_angle"]

CHILDREN = ("link1", "link2")  # of joint1 and joint2
ANGLE = 1e-3  # radians; far below the effect of a wrong amplitude, frequency or phase
_REAL_TIME_ANGLE = 0.05  # radians; real time is known less precisely
_STARTUP_TIME = SECOND // 5  # the simulated clock jumps to its start time
_MAX_LATE = 0.1  # seconds by which a stamp can differ from the clock
_STEP = 0.002  # seconds between two possible start times
# The motion begins when the node starts, before its first message. It also begins at 0 if the node reads its start
# before it has received the time.
_BEFORE_FIRST, _AFTER_FIRST, _AROUND_ZERO = 1.0, 0.02, 0.02
_AMPLITUDES, _FREQUENCIES, _PHASES = (0.5, 0.3), (0.2, 0.3), (0.0, np.pi / 4)
_TWO_PI = 2.0 * np.pi
_MIN_SAMPLES = 2  # after the first one


def specified_angle(joint: int, seconds: Array) -> Array:
    """Return the specified angle of joint 0 or 1, in radians, at times since the start."""
    return np.asarray(
        _AMPLITUDES[joint] * np.sin(_TWO_PI * _FREQUENCIES[joint] * seconds + _PHASES[joint]), dtype=np.float64
    )


def angle_of(message: Any) -> float:
    """Return the angle about z of a TransformStamped message."""
    return float(2.0 * np.arctan2(message.transform.rotation.z, message.transform.rotation.w))


class Formula(NamedTuple):
    """A formula of the quaternion of a joint, correct or with a common mistake.

    Attributes:
        cause: The mistake, or "" for the correct formula.
        quaternions: Returns the published quaternions x, y, z, w for angles in radians.
    """

    cause: str
    quaternions: Callable[[Array], Array]


def _about_z(angles: Array) -> Array:
    zero = np.zeros_like(angles)
    return np.stack([zero, zero, np.sin(angles / 2.0), np.cos(angles / 2.0)], axis=-1)


_FORMULAS = (
    Formula("", _about_z),
    Formula("sin(q) and cos(q) are used instead of sin(q / 2) and cos(q / 2)", lambda q: _about_z(2.0 * q)),
    Formula("the angle is halved twice: use sin(q / 2) and cos(q / 2)", lambda q: _about_z(q / 2.0)),
    Formula("the angle is in degrees: math.sin and math.cos take radians", lambda q: _about_z(np.degrees(q))),
    Formula("the angle, which is in radians, is converted from degrees", lambda q: _about_z(np.radians(q))),
    Formula("the sign of the angle is changed: use sin(q / 2), without a minus", lambda q: _about_z(-q)),
    Formula(
        "the quaternion is in the order w, x, y, z; ROS uses x, y, z, w", lambda q: np.roll(_about_z(q), 1, axis=-1)
    ),
    Formula("sine and cosine are exchanged: z = sin(q / 2), w = cos(q / 2)", lambda q: _about_z(q)[..., [0, 1, 3, 2]]),
    Formula("the rotation is about x instead of z", lambda q: _about_z(q)[..., [2, 1, 0, 3]]),
    Formula("the rotation is about y instead of z", lambda q: _about_z(q)[..., [0, 2, 1, 3]]),
)


class _Law(NamedTuple):
    """A formula of the angle over time, correct or with a common mistake."""

    cause: str
    angles: Callable[[int, Array], Array]


def _other_frequency(factor: float) -> Callable[[int, Array], Array]:
    return lambda joint, t: _AMPLITUDES[joint] * np.sin(factor * _FREQUENCIES[joint] * t + _PHASES[joint])


_LAWS = (
    _Law("", specified_angle),
    _Law("the factor 2 pi is missing: the frequencies are in Hz", _other_frequency(1.0)),
    _Law("the angles of the two joints are exchanged", lambda joint, t: specified_angle(1 - joint, t)),
    _Law(
        "the phase is missing: q2 begins at pi / 4",
        lambda joint, t: _AMPLITUDES[joint] * np.sin(_TWO_PI * _FREQUENCIES[joint] * t),
    ),
    _Law(
        "the sine and the cosine of the motion are exchanged",
        lambda joint, t: _AMPLITUDES[joint] * np.cos(_TWO_PI * _FREQUENCIES[joint] * t + _PHASES[joint]),
    ),
)
_STILL_CAUSE = "the angle does not change: the time since the start does not advance, or it is not used"
_COUNTED_CAUSE = (
    "the time is counted in calls of the timer, which may be late: compute it from the clock, "
    "(now - start).nanoseconds / 1e9"
)
_REAL_TIME_CAUSE = "the time is that of the system (time.time()): use the clock of the node, self.get_clock().now()"


class JointSamples(NamedTuple):
    """The published transforms of one joint.

    Attributes:
        times: Their stamps in seconds, or the simulated times of arrival if the stamps are wrong.
        arrived: The real times of arrival, in seconds.
        quaternions: Their quaternions x, y, z, w, normalized, shape (N, 4).
        first: The time of the first sample.
    """

    times: Array
    arrived: Array
    quaternions: Array
    first: float

    @classmethod
    def of(cls, messages: Sequence[Received], child: str) -> JointSamples:
        """Return the samples of a child frame."""
        found = [(one, each) for one in messages for each in one.message.transforms if each.child_frame_id == child]
        stamps = np.array([to_seconds(stamp_ns(each)) for _, each in found])
        arrivals = np.array([to_seconds(one.time) for one, _ in found])
        usable = len(stamps) and np.median(np.abs(stamps - arrivals)) <= _MAX_LATE
        times = stamps if usable else arrivals
        kept = np.flatnonzero(times > times[0] + to_seconds(_STARTUP_TIME)) if len(times) else np.array([], int)
        values = np.array([quaternion_values(each.transform.rotation) for _, each in found]).reshape(-1, 4)
        norms = np.linalg.norm(values, axis=1, keepdims=True)
        with np.errstate(all="ignore"):
            values = np.where(np.isfinite(norms) & (norms > 0.0), values / norms, 0.0)
        began = times[times > 0.0]
        return cls(
            times[kept],
            np.array([one.arrived for one, _ in found])[kept],
            values[kept],
            float(began[0]) if len(began) else 0.0,
        )

    def starts(self) -> Array:
        """Return the possible times at which the motion began."""
        near = np.arange(self.first - _BEFORE_FIRST, self.first + _AFTER_FIRST, _STEP)
        return np.concatenate([near, np.arange(-_AROUND_ZERO, _AROUND_ZERO, _STEP)])


class Motion(NamedTuple):
    """What was found out about the motion of both joints.

    Attributes:
        is_right: Whether each joint follows the specified motion.
        causes: The mistake of each joint, or "".
        formula: The formula of the quaternions, with its mistake; it also applies to joint states.
    """

    is_right: tuple[bool, bool]
    causes: tuple[str, str]
    formula: Formula

    @classmethod
    def of(cls, messages: Sequence[Received], period: float) -> Motion:
        """Examine the messages of a program without joint states.

        Args:
            messages: The messages.
            period: The period of the timer in the assignment, in seconds.
        """
        samples = [JointSamples.of(messages, child) for child in CHILDREN]
        found = [_find_trial(joint, each, period) for joint, each in enumerate(samples)]
        right = [trial is not None and not trial.cause for trial in found]
        causes = ["" if trial is None else trial.cause for trial in found]
        if all(right) and not _have_common_start(samples):
            right[1] = False
            causes[1] = "the two joints do not start at the same time"
        formula = next((trial.formula for trial in found if trial is not None), _FORMULAS[0])
        return cls((right[0], right[1]), (causes[0], causes[1]), formula)


class _Trial(NamedTuple):
    cause: str
    formula: Formula


def _find_trial(joint: int, samples: JointSamples, period: float) -> _Trial | None:
    """Return the first trial that explains the samples of a joint, or None if there is none."""
    if len(samples.times) < _MIN_SAMPLES:
        return None
    for law in _LAWS:
        for formula in _FORMULAS:
            if law.cause and formula.cause:
                continue
            angles = law.angles(joint, samples.times[None, :] - samples.starts()[:, None])
            if _deviation(formula, angles, samples.quaternions).min() <= ANGLE:
                return _Trial(law.cause or formula.cause, formula)
    if np.abs(np.abs(samples.quaternions @ samples.quaternions[0]) - 1.0).max() < 1e-12:
        return _Trial(_STILL_CAUSE, _FORMULAS[0])
    return _other_time(joint, samples, period)


def _other_time(joint: int, samples: JointSamples, period: float) -> _Trial | None:
    """Return the trial with a time that is not that of the clock of the node, or None if there is none."""
    offsets = np.arange(-_BEFORE_FIRST, _BEFORE_FIRST, _STEP)
    counted = np.arange(len(samples.times)) * period
    for cause, times, limit in (
        (_COUNTED_CAUSE, counted, ANGLE),
        (_REAL_TIME_CAUSE, samples.arrived - samples.arrived[0], _REAL_TIME_ANGLE),
    ):
        for formula in _FORMULAS[:1]:
            angles = specified_angle(joint, times[None, :] - offsets[:, None])
            if _deviation(formula, angles, samples.quaternions).min() <= limit:
                return _Trial(cause, formula)
    return None


def _deviation(formula: Formula, angles: Array, quaternions: Array) -> Array:
    """Return the maximum angle between predicted (S, N) and published (N, 4) rotations, for each of S start times."""
    cosines = np.abs(np.einsum("snk,nk->sn", formula.quaternions(angles), quaternions))
    return np.asarray(2.0 * np.sqrt(np.maximum(2.0 * (1.0 - cosines), 0.0)).max(axis=1))


def _have_common_start(samples: Sequence[JointSamples]) -> bool:
    starts = samples[0].starts()
    both = np.zeros(len(starts))
    for joint, each in enumerate(samples):
        angles = specified_angle(joint, each.times[None, :] - starts[:, None])
        both = np.maximum(both, _deviation(_FORMULAS[0], angles, each.quaternions))
    return bool(both.min() <= ANGLE)
