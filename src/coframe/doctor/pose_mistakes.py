# SPDX-License-Identifier: Apache-2.0
"""Common mistakes in poses: quaternions in another order, degrees used as radians, inverted transforms, other units.

A mistake is recognized by trial: it is applied to a pose that is known from other data, and undone in the published
one. If they then agree, :func:`explain` names the mistake with the remaining difference; otherwise it returns None.
Where the right pose is not known, :func:`corrections` yields what may have been meant, to be compared with other data.
All functions are pure.

A pose is a row x, y, z in meters and qx, qy, qz, qw.
"""

from __future__ import annotations

from functools import partial
from itertools import permutations, product
from math import degrees, pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import quaternion
from coframe.doctor._edge import angles_between

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Trial = Callable[[Array], Sequence[Array]]

__all__ = [
    "OPTICAL_ROTATION",
    "Correction",
    "Explanation",
    "all_rpy_angles",
    "angle_text",
    "corrections",
    "explain",
    "explain_mutual_difference",
    "inverse_poses",
    "length_text",
    "rotation_text",
]

OPTICAL_ROTATION = quaternion.from_rpy(np.array([-pi / 2, 0.0, -pi / 2]))
"""The rotation of an optical frame relative to the body of a camera by REP-103: z forward, x right, y down."""

_MAX_DISTANCE = 1e-3
_MAX_ANGLE = 1e-3
_FIRST_AMBIGUOUS_RANK = 3  # the ranks below: an inverted transform, and the two wrong orders of quaternions
_MIN_RATIO = 5.0  # A mistake must explain at least this multiple of what remains.
_MAX_ANGLE_ERROR = 2e-5  # radians, for angles that were typed in degrees
_GIMBAL_LOCK = 1e-3  # radians from a pitch of 90 degrees, where roll and yaw rotate about the same axis
_ANGLE_STEP = 5.0  # degrees; typed angles are multiples of this
_AXES = "xyz"
_ANGLES = ("roll", "pitch", "yaw")
_UNITS = (
    ("millimeters", 1e3),
    ("centimeters", 1e2),
    ("inches", 1 / 0.0254),
    ("feet", 1 / 0.3048),
)


class Mistake(NamedTuple):
    """A mistake in rotations (N, 4) or translations (N, 3).

    Attributes:
        reading: The clause after "if": what makes the published value right.
        fix: What to do.
        apply_mistake: Returns what is published instead of the right values, in each variant of the mistake.
        undo_mistake: Returns the values that may have been meant by the published ones.
        precision: By how much the mistake makes a difference smaller.
    """

    reading: str
    fix: str
    apply_mistake: Trial
    undo_mistake: Trial
    precision: float = 1.0


class Explanation(NamedTuple):
    """A mistake that explains the difference between a published and an expected pose.

    Attributes:
        reading: The clause after "if": what makes the published pose right.
        fix: What to do, without the right values.
        meters: The distance that remains, as the median of all rows, or NaN if only the rotation is explained.
        radians: The angle that remains, or NaN if only the translation is explained.
        rank: How special the mistake is: a lower number is a less ambiguous mistake.
    """

    reading: str
    fix: str
    meters: float
    radians: float
    rank: int = 0

    @property
    def is_specific(self) -> bool:
        """Whether poses hardly ever match by chance: the mistake changes all their numbers."""
        return self.rank < _FIRST_AMBIGUOUS_RANK and not np.isnan(self.meters + self.radians)

    def text(self, other: str, pose: str = "the pose") -> str:
        """Return the explanation as a sentence: the mistake, the remaining difference, and the condition."""
        subject, within = pose, f"{length_text(self.meters)} and {angle_text(self.radians)}"
        if np.isnan(self.meters):
            subject, within = f"the rotation of {pose}", angle_text(self.radians)
        elif np.isnan(self.radians):
            subject, within = f"the translation of {pose}", length_text(self.meters)
        return f"{subject} agrees with {other} within {within} if {self.reading}"


class Correction(NamedTuple):
    """A pose (7,) that may have been intended instead of the published one, by one mistake."""

    reading: str
    fix: str
    pose: Array


def explain(
    published: Array, expected: Array, *, meters: float = _MAX_DISTANCE, radians: float = _MAX_ANGLE
) -> Explanation | None:
    """Return the mistake that makes the expected poses the published ones, or None if no common mistake does.

    Args:
        published: (N, 7) poses, with unit quaternions.
        expected: (N, 7) poses at the same times, from other data.
        meters: The distance that may remain.
        radians: The angle that may remain.

    Example:
        >>> expected = np.array([[0.1, 0.0, 0.3, *quaternion.from_rpy(np.array([0.0, 0.0, 1.0]))]])
        >>> published = np.concatenate([expected[:, :3], np.roll(expected[:, 3:], 1, axis=1)], axis=1)
        >>> explain(published, expected).text("the URDF")
        'the pose agrees with the URDF within 0 mm and 0 degrees if its quaternion is read as w, x, y, z'
    """
    place, rotation = published[:, :3], published[:, 3:]
    right_place, right_turn = expected[:, :3], expected[:, 3:]
    distance, angle = _distance(place, right_place), _rotation(rotation, right_turn)
    if distance <= meters and angle <= radians:
        return None
    inverse_explanation = _explain_inverse(published, expected, (meters, radians), (distance, angle))
    if inverse_explanation is not None:
        return inverse_explanation
    moved = _first(_translations(right_turn), place, right_place, meters, _distance) if distance > meters else None
    rotated = _first(_AXIS_ROTATIONS, rotation, right_turn, radians, _rotation) if angle > radians else None
    parts = [part for part in (rotated, moved) if part is not None]
    if not parts:
        return None
    return Explanation(
        " and ".join(part.mistake.reading for part in parts),
        " ".join(dict.fromkeys(part.mistake.fix for part in parts)),
        moved.left if moved else distance if distance <= meters else float("nan"),
        rotated.left if rotated else angle if angle <= radians else float("nan"),
        rank=sum(1 + part.rank for part in parts),
    )


def explain_mutual_difference(
    first: Array, second: Array, *, meters: float = _MAX_DISTANCE, radians: float = _MAX_ANGLE
) -> tuple[Explanation, bool] | None:
    """Return the least ambiguous mistake that explains how two poses differ, either of which may be the wrong one.

    Returns:
        The mistake, and whether it is in the first poses, or None if no common mistake explains the difference.
    """
    limits = {"meters": meters, "radians": radians}
    found = [(explain(first, second, **limits), True), (explain(second, first, **limits), False)]
    explained = [(mistake, in_first) for mistake, in_first in found if mistake is not None]
    return min(explained, key=lambda pair: pair[0].rank, default=None)


def corrections(pose: Array) -> Iterator[Correction]:
    """Yield the poses (7,) that may have been intended instead of the published one, by each common mistake.

    The caller compares them with other data: gravity, the points of a lidar, or the axes of a camera.
    """
    place, rotation = pose[:3], pose[None, 3:]
    inverse = inverse_poses(pose[None])[0]
    for mistake in _AXIS_ROTATIONS:
        for corrected_rotation in mistake.undo_mistake(rotation):
            yield Correction(mistake.reading, mistake.fix, np.concatenate([place, corrected_rotation[0]]))
    yield Correction(_INVERTED, _INVERTED_FIX, inverse)


def rotation_text(rotation: Array) -> str:
    """Return a rotation (4,) as roll, pitch and yaw in degrees.

    Example:
        >>> rotation_text(OPTICAL_ROTATION)
        'roll -90, pitch 0, yaw -90 degrees'
    """
    angles = [f"{value + 0.0:.6g}" for value in np.round(np.degrees(quaternion.to_rpy(rotation)), 2).tolist()]
    return ", ".join(f"{name} {angle}" for name, angle in zip(_ANGLES, angles, strict=True)) + " degrees"


# Whole poses

_INVERTED = "it is inverted"
_INVERTED_FIX = (
    "The inverse was published, as if parent and child were swapped: publish transform.inverse(). In a transform the "
    "translation is the position of the child frame in the parent frame."
)
_BODY_READING = "its rotation is that of the camera's body, not that of its optical frame"
_BODY_FIX = "Add the rotation of optical frames (REP-103): roll -90, pitch 0, yaw -90 degrees."


def _explain_inverse(
    published: Array, expected: Array, limits: tuple[float, float], difference: tuple[float, float]
) -> Explanation | None:
    inverse = inverse_poses(published)
    left = _distance(inverse[:, :3], expected[:, :3]), _rotation(inverse[:, 3:], expected[:, 3:])
    fits = all(rest <= limit for rest, limit in zip(left, limits, strict=True))
    explains = any(_MIN_RATIO * rest < before for rest, before in zip(left, difference, strict=True))
    return Explanation(_INVERTED, _INVERTED_FIX, *left) if fits and explains else None


def inverse_poses(poses: Array) -> Array:
    """Return the inverse of poses (N, 7)."""
    rotation = quaternion.inverse(poses[:, 3:])
    return np.concatenate([-quaternion.rotate(rotation, poses[:, :3]), rotation], axis=1)


class _MistakeFit(NamedTuple):
    """A mistake that fits, its position in the list, and the difference that remains."""

    mistake: Mistake
    rank: int
    left: float


def _first(
    mistakes: Sequence[Mistake],
    published: Array,
    expected: Array,
    limit: float,
    measure: Callable[[Array, Array], float],
) -> _MistakeFit | None:
    """Return the first mistake that explains the difference, with the remaining difference."""
    before = measure(published, expected)
    for rank, mistake in enumerate(mistakes):
        undone = [measure(candidate, expected) for candidate in mistake.undo_mistake(published)]
        committed = [measure(candidate, published) / mistake.precision for candidate in mistake.apply_mistake(expected)]
        left = min((*undone, *committed), default=np.inf)
        if left <= limit and _MIN_RATIO * left < before:
            return _MistakeFit(mistake, rank, left)
    return None


def _distance(first: Array, second: Array) -> float:
    return float(np.median(np.linalg.norm(first - second, axis=1)))


def _rotation(first: Array, second: Array) -> float:
    return float(np.median(angles_between(first, second)))


# Rotations


def all_rpy_angles(rotation: Array) -> list[Array]:
    """Return all roll, pitch, yaw (N, 3) that give a rotation, with angles between -pi and pi."""
    rpy = quaternion.to_rpy(rotation)
    roll, pitch, yaw = rpy.T
    triples = [rpy, np.stack([roll + pi, pi - pitch, yaw + pi], axis=1)]
    if (np.abs(np.abs(pitch) - pi / 2) < _GIMBAL_LOCK).all():
        # Only the sum or the difference of roll and yaw is known.
        sum_ = roll - np.sign(pitch) * yaw
        zero = np.zeros_like(roll)
        triples += [np.stack([zero, pitch, -np.sign(pitch) * sum_], axis=1)]
    return [(triple + pi) % (2.0 * pi) - pi for triple in triples]


def _permute_angles(order: tuple[int, int, int], rotation: Array) -> list[Array]:
    return [quaternion.from_rpy(triple[:, order]) for triple in all_rpy_angles(rotation)]


def _angle_order_mistake(order: tuple[int, int, int]) -> Mistake:
    back = (order.index(0), order.index(1), order.index(2))
    names = ", ".join(_ANGLES[index] for index in order)
    return Mistake(
        f"its angles are read in the order {names} instead of roll, pitch, yaw",
        "Check the order of the angles: roll about x, pitch about y, yaw about z.",
        partial(_permute_angles, order),
        partial(_permute_angles, back),
    )


def _other_convention(rotation: Array) -> list[Array]:
    """Return rotations about moving instead of fixed axes, in the order x, y, z."""
    found = []
    for triple in all_rpy_angles(rotation):
        parts = [quaternion.from_rpy(triple * np.eye(3)[axis]) for axis in range(3)]
        found.append(quaternion.multiply(quaternion.multiply(parts[0], parts[1]), parts[2]))
    return found


def _from_fixed_axes(rotation: Array) -> list[Array]:
    """Return the rotations about fixed axes with the angles that rotations about moving axes have."""
    # R = Rx(a) Ry(b) Rz(c) is the inverse of Rz(-c) Ry(-b) Rx(-a), whose roll, pitch and yaw are -a, -b, -c.
    return [quaternion.from_rpy(-triple) for triple in all_rpy_angles(quaternion.inverse(rotation))]


def _degrees_as_radians(rotation: Array) -> list[Array]:
    found = []
    for triple in all_rpy_angles(rotation):
        angles = np.degrees(triple)
        for values in (angles, np.round(angles / _ANGLE_STEP) * _ANGLE_STEP):
            if np.abs(values - angles).max() > 0.1:  # degrees; not round
                continue
            for turns in product((0.0, -360.0, 360.0), repeat=3):
                shifted = values + np.array(turns)
                if np.abs(shifted).max() <= 360.0 and (shifted[:, np.array(turns) != 0.0] != 0.0).all():
                    found.append(quaternion.from_rpy(shifted))
    return found


def _round_degrees(rotation: Array) -> list[Array]:
    """Return the rotations by round angles in degrees that give these rotations if they are used as radians."""
    found = []
    for triple in all_rpy_angles(rotation[:1]):
        choices = [_round_angles(angle) for angle in triple[0].tolist()]
        if any(value != 0.0 for choice in choices for value in choice):
            found += [quaternion.from_rpy(np.radians([each])) for each in product(*choices) if any(each)]
    return found if len(rotation) == 1 else []


def _round_angles(angle: float) -> list[float]:
    values = np.arange(-360.0, 360.0 + _ANGLE_STEP, _ANGLE_STEP)
    deviations = np.abs((values - angle + pi) % (2.0 * pi) - pi)
    return [float(value) for value in values[deviations < _MAX_ANGLE_ERROR]]


def _to_radians(rotation: Array) -> list[Array]:
    return [quaternion.from_rpy(np.radians(triple)) for triple in all_rpy_angles(rotation)]


def _to_degrees(rotation: Array) -> list[Array]:
    return [quaternion.from_rpy(np.degrees(all_rpy_angles(rotation)[0]))]


def _double_angle(rotation: Array) -> list[Array]:
    angles = [quaternion.from_rpy(2.0 * triple) for triple in all_rpy_angles(rotation)]
    return [quaternion.multiply(rotation, rotation), *angles]


def _halve_angle(rotation: Array) -> list[Array]:
    one = np.array([0.0, 0.0, 0.0, 1.0])
    found = []
    for sign in (1.0, -1.0):
        half = sign * rotation + one
        length = np.linalg.norm(half, axis=1, keepdims=True)
        if (length > 1e-6).all():
            found.append(half / length)
    return [*found, *(quaternion.from_rpy(triple / 2.0) for triple in all_rpy_angles(rotation))]


def _negate_angle(axis: int, rotation: Array) -> list[Array]:
    signs = np.where(np.arange(3) == axis, -1.0, 1.0)
    return [quaternion.from_rpy(triple * signs) for triple in all_rpy_angles(rotation)[:1]]


def _clear_angle(axis: int, rotation: Array) -> list[Array]:
    kept = np.where(np.arange(3) == axis, 0.0, 1.0)
    return [quaternion.from_rpy(triple * kept) for triple in all_rpy_angles(rotation)]


def _times(right: Array, rotation: Array) -> list[Array]:
    return [quaternion.multiply(rotation, right[None])]


def _reorder_components(order: tuple[int, ...], rotation: Array) -> list[Array]:
    return [rotation[:, order]]


def _axis_rotation_mistake(axis: int, angle: int) -> Mistake:
    rotation = quaternion.from_rpy(np.radians(angle) * np.eye(3)[axis])
    axes = " (its axes are those of OpenGL: y up, z backward)" if (axis, angle) == (0, 180) else ""
    return Mistake(
        f"it is turned by {angle} degrees about its {_AXES[axis]} axis{axes}",
        f"Check the axes of the frame: it differs by {angle} degrees about {_AXES[axis]}.",
        partial(_times, quaternion.inverse(rotation)),
        partial(_times, rotation),
    )


def _make_identity(rotation: Array) -> list[Array]:
    return [np.broadcast_to(np.array([0.0, 0.0, 0.0, 1.0]), rotation.shape)]


def _no_candidates(_: Array) -> list[Array]:
    return []


_HALF_ANGLE_HINT = (
    "Use half the angle in a quaternion: z = math.sin(yaw / 2), w = math.cos(yaw / 2); or Transform.from_rpy, with the "
    "whole angles."
)
_AXIS_ROTATIONS = (
    Mistake(
        "its quaternion is read as w, x, y, z",
        "A quaternion of ROS is x, y, z, w: set rotation.x, .y, .z from the vector and rotation.w from the scalar.",
        partial(_reorder_components, (3, 0, 1, 2)),
        partial(_reorder_components, (1, 2, 3, 0)),
    ),
    Mistake(
        "its quaternion x, y, z, w was passed to a function that expects w, x, y, z",
        "Check the order of the function: a quaternion of ROS and of SciPy is x, y, z, w; that of transforms3d, MATLAB "
        "and Eigen's constructor is w, x, y, z.",
        partial(_reorder_components, (1, 2, 3, 0)),
        partial(_reorder_components, (3, 0, 1, 2)),
    ),
    Mistake(
        "its angles are degrees that were used as radians",
        "Use radians: math.radians(90), numpy.radians(angles).",
        _degrees_as_radians,
        _round_degrees,
    ),
    Mistake(
        "its angles are radians that were converted from degrees to radians twice",
        "Convert angles to radians only once.",
        _to_radians,
        _to_degrees,
        precision=pi / 180.0,
    ),
    Mistake("its rotation is inverted", "Publish the inverse rotation: the columns of the matrix are the axes of the "
            "child frame in the parent frame; use R.T for R, and -x, -y, -z, w for x, y, z, w.",
            lambda turn: [quaternion.inverse(turn)], lambda turn: [quaternion.inverse(turn)]),
    Mistake(
        _BODY_READING,
        _BODY_FIX,
        partial(_times, quaternion.inverse(OPTICAL_ROTATION)),
        partial(_times, OPTICAL_ROTATION),
    ),
    Mistake(
        "its rotation is that of an optical frame, and the frame is the body of the camera",
        "Remove the rotation of optical frames (REP-103), or publish it for the optical frame.",
        partial(_times, OPTICAL_ROTATION),
        partial(_times, quaternion.inverse(OPTICAL_ROTATION)),
    ),
    _axis_rotation_mistake(0, 180),
    Mistake(
        "its angle is halved (the angle was used for the half angle)", _HALF_ANGLE_HINT, _double_angle, _halve_angle
    ),
    Mistake("its angle is doubled (the angle was halved twice)", _HALF_ANGLE_HINT, _halve_angle, _double_angle),
    *(_angle_order_mistake((a, b, c)) for a, b, c in ((2, 1, 0), *permutations(range(3))) if (a, b, c) != (0, 1, 2)),
    Mistake(
        "its angles are applied about fixed axes (extrinsic x, y, z), not about moving ones",
        "Use the convention of ROS: yaw about z, then pitch about the new y, then roll about the new x; in SciPy this "
        "is Rotation.from_euler('xyz', angles) with lower-case letters.",
        _other_convention,
        _from_fixed_axes,
    ),
    *(
        Mistake(
            f"the sign of its {_ANGLES[axis]} is changed",
            f"Check the sign of {_ANGLES[axis]}: positive angles turn counterclockwise, seen against the axis.",
            partial(_negate_angle, axis),
            partial(_negate_angle, axis),
        )
        for axis in range(3)
    ),
    Mistake(
        "its rotation is set; the published rotation is the identity",
        "Set the rotation.",
        _make_identity,
        _no_candidates,
    ),
    *(
        Mistake(
            f"its {_ANGLES[axis]} is set; the published value is 0", f"Set {_ANGLES[axis]}.",
            partial(_clear_angle, axis), _no_candidates,
        )
        for axis in range(3)
    ),
    *(
        _axis_rotation_mistake(axis, angle)
        for axis, angle in product(range(3), (180, 90, -90))
        if (axis, angle) != (0, 180)
    ),
)  # fmt: skip


# Translations


def _unit_mistake_texts(unit: str) -> tuple[str, str]:
    return f"its translation is read in {unit}", f"Use meters: divide by {_units_per_meter(unit)}."


def _units_per_meter(unit: str) -> str:
    return f"{dict(_UNITS)[unit]:.6g}"


def _scale(factor: float, place: Array) -> list[Array]:
    return [place * factor]


def _reorder_axes(order: tuple[int, ...], place: Array) -> list[Array]:
    return [place[:, order]]


def _translations(rotation: Array) -> list[Mistake]:
    """Return the mistakes in translations, given the right rotations."""
    inverse = quaternion.inverse(rotation)
    found = [
        Mistake(
            *_unit_mistake_texts(unit),
            partial(_scale, factor),
            partial(_scale, 1.0 / factor),
            precision=max(factor, 1.0),
        )
        for unit, factor in _UNITS
    ]
    found.append(
        Mistake(
            "its translation is read in thousands of meters (the values were divided by 1000 twice)",
            "Convert millimeters to meters only once.",
            partial(_scale, 1e-3),
            partial(_scale, 1e3),
            precision=1e-3,
        )
    )
    for axes in ((0,), (1,), (2,), (0, 1, 2)):
        signs = np.where(np.isin(np.arange(3), axes), -1.0, 1.0)
        names = " and ".join(_AXES[axis] for axis in axes) if len(axes) == 1 else "its translation"
        flip = partial(_apply_signs, signs)
        found.append(
            Mistake(
                f"the sign of {names} is changed", f"Check the sign of {names}: x forward, y left, z up.", flip, flip
            )
        )
    for order in permutations(range(3)):
        if order != (0, 1, 2):
            back = (order.index(0), order.index(1), order.index(2))
            names = ", ".join(_AXES[axis] for axis in back)
            found.append(
                Mistake(
                    f"its translation is read in the order {names}",
                    "Check the order of the coordinates: x forward, y left, z up.",
                    partial(_reorder_axes, order),
                    partial(_reorder_axes, back),
                )
            )
    found.append(
        Mistake(
            "its translation, which is in the axes of the child, is rotated into those of the parent",
            "The translation of a transform is in the axes of the parent frame.",
            lambda place: [quaternion.rotate(inverse, place)],
            lambda place: [quaternion.rotate(rotation, place)],
        )
    )
    found.append(
        Mistake(
            "its translation, which is the position of the parent in the child, is inverted",
            "The translation of a transform is the position of the child frame in the parent frame: -R t.",
            lambda place: [-quaternion.rotate(inverse, place)],
            lambda place: [-quaternion.rotate(rotation, place)],
        )
    )
    found.append(
        Mistake("its translation is set; the published value is 0", "Set the translation.", _origin, _no_candidates)
    )
    return found


def _apply_signs(signs: Array, place: Array) -> list[Array]:
    return [place * signs]


def _origin(place: Array) -> list[Array]:
    return [np.zeros_like(place)]


# Figures


def length_text(meters: float) -> str:
    """Return a distance in millimeters, or from one meter in meters.

    Example:
        >>> length_text(2.5e-13), length_text(0.0042), length_text(0.0973), length_text(1738.4)
        ('0 mm', '4.2 mm', '97 mm', '1740 m')
    """
    if meters < 1.0:
        return f"{round(meters * 1e3, 2 if meters < 1e-2 else 0):g} mm"
    return f"{float(f'{meters:.3g}'):g} m"


def angle_text(radians: float) -> str:
    """Return an angle in degrees, with three decimal places.

    Example:
        >>> angle_text(pi / 7)
        '25.714 degrees'
    """
    return f"{round(degrees(radians), 3):g} degrees"
