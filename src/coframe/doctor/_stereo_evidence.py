# SPDX-License-Identifier: Apache-2.0
"""Stereo pairs whose transforms contradict their calibration: P has the baseline, and R the rotation between them."""

from __future__ import annotations

from itertools import chain, product
from math import degrees
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import quaternion
from coframe.doctor.pose_mistakes import Correction, angle_text, corrections, inverse_poses, length_text

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from numpy.typing import NDArray

    from coframe.cameras import CameraModel
    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation, ObservedCamera

    Array = NDArray[np.float64]
    _Mounts = tuple[tuple[Edge, Array], ...]

__all__ = ["StereoContradiction", "stereo_contradictions"]

_MIN_BASELINE = 1e-3  # meters; below it, the image is that of a single camera
_MAX_SHARE, _MAX_DISTANCE = 0.03, 3e-3  # of a baseline by which two calibrations may differ, and meters
_MAX_FOCAL_DIFFERENCE = 1e-3  # of the focal lengths of a rectified pair, which are equal
_MIN_WRONG_ANGLE, _MAX_RIGHT_ANGLE = np.radians(1.5), np.radians(0.5)
_MIN_WRONG_BASELINE_ANGLE = np.radians(3.0)  # of the direction of the baseline; below it, its value or sign is wrong
_UNITS = (("millimeters", 1e3), ("centimeters", 1e2), ("inches", 1 / 0.0254))


class StereoContradiction(NamedTuple):
    """A stereo pair whose transforms contradict its calibration.

    Attributes:
        topic: The topic of the CameraInfo with the baseline.
        text: The two values, and the mistake with which they agree.
        fix: What to do.
        mounts: The mounts with their right poses (7,), or none if the CameraInfo is more likely wrong.
    """

    topic: str
    text: str
    fix: str
    mounts: tuple[tuple[Edge, Array], ...] = ()


class _Pair(NamedTuple):
    """The first camera of a pair, the other one with the baseline in its P, and the mounts from the first to it."""

    first: ObservedCamera
    second: ObservedCamera
    up: list[Edge]
    down: list[Edge]

    def relative(self, changed: _Mounts = ()) -> Array:
        """Return the pose (7,) of the second camera in the first one, with other poses of some mounts."""
        return _compose(_inverse(_chain(self.up, changed)), _chain(self.down, changed))


class _Hypothesis(NamedTuple):
    """A mistake in the mounts of a pair, and their poses (7,) without it."""

    reading: str
    fix: str
    mounts: _Mounts


def stereo_contradictions(observation: Observation) -> Iterator[StereoContradiction]:
    """Yield the stereo pairs whose transforms contradict P and R, and the mistake that explains it."""
    for second in observation.cameras:
        if second.model is None or not second.model.p[:2, 3].any():
            continue
        check = _contradiction if _baseline(second.model) >= _MIN_BASELINE else _baseline_without_focal_length
        found = [check(pair) for pair in _pairs(observation, second)]
        # Of several cameras that can be the first one, any may agree.
        if found and all(one is not None for one in found):
            yield next(one for one in found if one is not None)


def _baseline(model: CameraModel) -> float:
    return float(np.hypot(*model.baseline))


def _pairs(observation: Observation, second: ObservedCamera) -> Iterator[_Pair]:
    """Yield the pairs with cameras without a baseline whose rectified images are like those of a camera."""
    model = second.model
    for first in observation.cameras:
        other = first.model
        if model is None or other is None or first.frame == second.frame or _baseline(other) >= _MIN_BASELINE:
            continue
        focal = model.p[0, 0], other.p[0, 0]
        if model.image_size != other.image_size or abs(focal[0] / focal[1] - 1.0) > _MAX_FOCAL_DIFFERENCE:
            continue
        frames = observation.structure.chain(first.frame, second.frame)
        if frames is None:
            continue
        up, down = observation.path(first.frame), observation.path(second.frame)
        shared = {edge.child for edge in up} & {edge.child for edge in down}
        up = [edge for edge in up if edge.child not in shared]
        down = [edge for edge in down if edge.child not in shared]
        if all(edge.static or edge.constant for edge in (*up, *down)):
            yield _Pair(first, second, up, down)


def _contradiction(pair: _Pair) -> StereoContradiction | None:
    first, second = pair.first.model, pair.second.model
    assert first is not None
    assert second is not None
    expected = np.array([*second.baseline, 0.0])
    relative = pair.relative()
    # P is about the rectified frames, whose axes R turns.
    published = first.r @ relative[:3]
    size, length = float(np.linalg.norm(expected)), float(np.linalg.norm(published))
    if length < _MIN_BASELINE:
        return None  # The driver publishes both cameras in one place, and the baseline in P only.
    turn = _angle_to(relative, first, second)
    limit = max(_MAX_DISTANCE, _MAX_SHARE * size)
    fits = float(np.linalg.norm(published - expected)) < max(limit, 2.0 * np.sin(_MIN_WRONG_ANGLE) * size)
    if fits and turn < _MIN_WRONG_ANGLE:
        return None
    before = float(np.linalg.norm(published - expected)), turn
    found: StereoContradiction | None
    if turn >= _MIN_WRONG_ANGLE:
        found = _wrong_mount(pair, _wrong_rotations(pair), expected, before)
        if found is None and fits:
            found = _wrong_rotation(pair, turn)
    else:
        is_turned = abs(float(published @ expected)) < np.cos(_MIN_WRONG_BASELINE_ANGLE) * size * length
        hypotheses = chain(_other_units(pair), _wrong_rotations(pair) if is_turned else ())
        found = _wrong_mount(pair, hypotheses, expected, before)
    return found or _wrong_baseline(pair.second.topic, second, expected, published, limit)


def _angle_to(relative: Array, first: CameraModel, second: CameraModel) -> float:
    """Return the angle between the rotation of a relative pose and that which R of both cameras states."""
    off = first.r @ quaternion.to_matrix(relative[3:]) @ second.r.T
    return float(np.arccos(np.clip((np.trace(off) - 1.0) / 2.0, -1.0, 1.0)))


def _wrong_mount(
    pair: _Pair, hypotheses: Iterable[_Hypothesis], expected: Array, before: tuple[float, float]
) -> StereoContradiction | None:
    """Return the first mistake with which rotation and baseline agree; `before` is how far they are off now."""
    first, second = pair.first.model, pair.second.model
    assert first is not None
    assert second is not None
    limit = max(_MAX_DISTANCE, _MAX_SHARE * float(np.linalg.norm(expected)))
    for reading, fix, mounts in hypotheses:
        relative = pair.relative(mounts)
        off = float(np.linalg.norm(first.r @ relative[:3] - expected))
        turn = _angle_to(relative, first, second)
        if off < limit and turn < _MAX_RIGHT_ANGLE and (5.0 * off < before[0] or 5.0 * turn < before[1]):
            condition = f"if this is true of the mounts of both cameras: {reading}" if mounts[1:] else f"if {reading}"
            text = (
                f"the transform from {pair.second.frame!r} to {pair.first.frame!r} differs from P and R of the pair by "
                f"{length_text(before[0])} and {angle_text(before[1])}; they agree within {length_text(off)} and "
                f"{angle_text(turn)} {condition}"
            )
            return StereoContradiction(pair.second.topic, text, fix, mounts)
    return None


def _wrong_rotation(pair: _Pair, turn: float) -> StereoContradiction:
    text = (
        f"the rotation between {pair.first.frame!r} and {pair.second.frame!r} differs by {degrees(turn):.3g} degrees "
        "from that of the calibration (R of both cameras)"
    )
    return StereoContradiction(pair.second.topic, text, "Calibrate the pair again, and publish both mounts from it.")


def _wrong_rotations(pair: _Pair) -> Iterator[_Hypothesis]:
    """Yield what the mounts may have been meant to be: with another rotation or their inverse."""
    return _hypotheses(pair, lambda pose: list(corrections(pose)))


def _other_units(pair: _Pair) -> Iterator[_Hypothesis]:
    """Yield what the mounts may have been meant to be: with their translation in meters."""
    return _hypotheses(
        pair,
        lambda pose: [
            Correction(
                f"its translation is read in {unit}",
                f"Use meters: divide by {factor:.6g}.",
                np.concatenate([pose[:3] / factor, pose[3:]]),
            )
            for unit, factor in _UNITS
        ],
    )


def _hypotheses(pair: _Pair, correct: Callable[[Array], list[Correction]]) -> Iterator[_Hypothesis]:
    """Yield the corrections of each mount, and the same correction of both cameras at once."""
    for edge in (*pair.up, *pair.down):
        for one in correct(edge.last_pose[0]):
            yield _Hypothesis(one.reading, one.fix, ((edge, one.pose),))
    if len(pair.up) != len(pair.down):
        return
    for edge, other in zip(pair.up, pair.down, strict=True):
        for one, same in product(correct(edge.last_pose[0]), correct(other.last_pose[0])):
            if one.reading == same.reading:
                yield _Hypothesis(one.reading, one.fix, ((edge, one.pose), (other, same.pose)))


def _baseline_without_focal_length(pair: _Pair) -> StereoContradiction | None:
    """Return a P whose fourth column is the baseline in meters, not that times the focal length."""
    first, second = pair.first.model, pair.second.model
    assert first is not None
    assert second is not None
    published = (first.r @ pair.relative()[:3])[:2]
    if abs(float(np.hypot(*second.p[:2, 3])) - float(np.hypot(*published))) > _MAX_SHARE * float(np.hypot(*published)):
        return None
    axis = int(np.argmax(np.abs(published)))
    place, value, focal = ("P[3]", "P[7]")[axis], second.p[axis, 3], second.p[axis, axis]
    text = (
        f"{place} = {value:.6g} states a baseline of {length_text(abs(value / focal))}, and by the transforms it is "
        f"{length_text(abs(published[axis]))}: {place} is the baseline in meters, without the focal length"
    )
    fix = f"Set {place} to {-published[axis] * focal:.6g} (-fx times the baseline)."
    return StereoContradiction(pair.second.topic, text, fix)


def _wrong_baseline(
    topic: str, model: CameraModel, expected: Array, published: Array, limit: float
) -> StereoContradiction:
    axis = int(np.argmax(np.abs(expected)))
    place, name = ("P[3]", "Tx") if axis == 0 else ("P[7]", "Ty")
    value, focal = float(model.p[axis, 3]), float(model.p[axis, axis])
    states = f"{place} = {value:.6g} states a baseline of {expected[axis]:.4g} m"
    right = -published[axis] * focal
    fix = f"If the transforms are right, {place} is {right:.6g} (-fx times the baseline)."
    if np.linalg.norm(published + expected) < max(limit, 0.1 * np.linalg.norm(expected)):
        text = (
            f"{states}, and by the transforms it is {published[axis]:.4g} m: the sign of {name} is wrong, or the two "
            "cameras or their frames are swapped"
        )
        return StereoContradiction(topic, text, f"{fix} {place} of the right or lower camera is negative.")
    for unit, factor in _UNITS:
        for scale in (factor, 1.0 / factor):
            if np.linalg.norm(published - expected / scale) < _MAX_SHARE * np.linalg.norm(published):
                where = place if scale > 1.0 else "the translation between the frames"
                text = (
                    f"{states}, and by the transforms it is {published[axis]:.4g} m: they agree if {where} is in {unit}"
                )
                in_meters = f"Use meters in the transforms: divide by {factor:.6g}."
                return StereoContradiction(topic, text, fix if scale > 1.0 else in_meters)
    text = f"{states}, but by the transforms it is {published[axis]:.4g} m ({np.linalg.norm(published):.4g} m apart)"
    return StereoContradiction(
        topic, text, f"{fix} Otherwise correct the transform: the cameras are {abs(expected[axis]):.4g} m apart."
    )


def _chain(edges: Sequence[Edge], changed: _Mounts) -> Array:
    """Return the pose of the lower end of some edges, from the bottom up, in their upper end."""
    pose = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    for edge in edges:
        own = next((other for one, other in changed if one is edge), edge.last_pose[0])
        pose = _compose(own, pose)
    return pose


def _compose(first: Array, second: Array) -> Array:
    place = first[:3] + quaternion.rotate(first[3:], second[:3])
    return np.concatenate([place, quaternion.multiply(first[3:], second[3:])])


def _inverse(pose: Array) -> Array:
    return np.asarray(inverse_poses(pose[None])[0])
