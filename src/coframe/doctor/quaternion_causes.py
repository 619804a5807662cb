# SPDX-License-Identifier: Apache-2.0
"""The likely mistake behind quaternions that are not rotations: a missing half angle, an angle used as a component."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import quaternion

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Cause", "likely_cause"]

_TOLERANCE = 1.5e-3  # for components that were typed with three digits
_NAMES = ("roll", "pitch", "yaw")
_ROTATION_FIELD = "t.transform.rotation."
_ANGLE_STEP = 5  # degrees; typed angles are multiples of this
_DEFAULT_W = 1.0


class Cause(NamedTuple):
    """The likely mistake.

    Attributes:
        text: The mistake that the quaternions show, as a clause.
        fix: The line of code to use, with the correct values of the first quaternion.
    """

    text: str
    fix: str


def likely_cause(quaternions: NDArray[np.float64]) -> Cause | None:
    """Return the mistake that explains all given quaternions, or None if there is none.

    Args:
        quaternions: (N, 4) x, y, z, w; finite, not 0, and not normalized.

    Example:
        >>> print(likely_cause(np.array([[0.0, 0.0, np.sin(0.25), np.cos(0.5)]])).fix)
        Use half the angle in both: z = math.sin(yaw / 2), w = math.cos(yaw / 2). For yaw = 28.6 degrees these are \
t.transform.rotation.z = 0.247404 and t.transform.rotation.w = 0.968912.
    """
    return _angles_as_components(quaternions) or _find_missing_half(quaternions) or _find_default_w(quaternions)


def _find_missing_half(quaternions: NDArray[np.float64]) -> Cause | None:
    w = quaternions[:, 3]
    v = np.linalg.norm(quaternions[:, :3], axis=1)
    sine = np.sqrt(np.maximum(1.0 - w * w, 0.0))
    if (v < _TOLERANCE).all() or (len(w) == 1 and abs(v[0] - abs(w[0])) < _TOLERANCE):
        return None  # an unnormalized rotation of 90 degrees also matches
    axis, component = _axis(quaternions)
    # The mistake, its residuals, and the angle of the first quaternion if it is right.
    candidates = (
        (f"w is cos({axis}) instead of cos({axis} / 2)", w - (1.0 - 2.0 * v * v), 2.0 * np.arcsin(min(v[0], 1.0))),
        (f"{component} is sin({axis}) instead of sin({axis} / 2)", v - 2.0 * np.abs(w) * sine, _angle_of(w[0])),
        (f"{component} is sin({axis}) / 2 instead of sin({axis} / 2)", v - np.abs(w) * sine, _angle_of(w[0])),
        (
            f"{component} and w are sin({axis}) / 2 and cos({axis}) / 2 instead of the sine and cosine of {axis} / 2",
            np.hypot(v, w) - 0.5,
            np.arctan2(v[0], w[0]),
        ),
    )
    text, residuals, angle = min(candidates, key=lambda candidate: float(np.abs(candidate[1]).max()))
    if not np.abs(residuals).max() < _TOLERANCE:
        return None
    return Cause(f"the half angle is missing: {text}", _fix_text(quaternions[0], float(angle)))


def _find_default_w(quaternions: NDArray[np.float64]) -> Cause | None:
    v = np.linalg.norm(quaternions[:, :3], axis=1)
    if not ((quaternions[:, 3] == _DEFAULT_W).all() and v.max() <= 1.0):
        return None
    _, component = _axis(quaternions)
    return Cause(
        f"w is 1, as if only {component} had been set",
        _fix_text(quaternions[0], 2.0 * float(np.arcsin(min(v[0], 1.0)))),
    )


def _angles_as_components(quaternions: NDArray[np.float64]) -> Cause | None:
    """Return the cause for angles that were set as x, y and z: in degrees, or one common angle in radians."""
    angles = quaternions[:, :3]
    if np.abs(angles).max(axis=1).min() <= 1.0 + _TOLERANCE:
        return None
    in_degrees = (angles % _ANGLE_STEP == 0).all() and np.abs(angles).max() <= 360.0
    steps = angles / np.radians(15.0)
    in_radians = np.abs(steps - np.round(steps)).max() < _TOLERANCE and np.abs(angles).max() <= 2.0 * np.pi + _TOLERANCE
    if not in_degrees and not in_radians:
        return None
    rpy = np.radians(angles[0]) if in_degrees else angles[0]
    right = quaternion.from_rpy(rpy)
    values = ", ".join(f"{name} = {value + 0.0:.6g}" for name, value in zip("xyzw", right.tolist(), strict=True))
    angles_text = _angles_text(rpy)
    return Cause(
        f"x, y and z look like the angles {angles_text} in {'degrees' if in_degrees else 'radians'}, "
        "not like components of a quaternion",
        f"Convert the angles: the quaternion of {angles_text} is {values}. "
        "In code: coframe.Transform.from_rpy([x, y, z], [roll, pitch, yaw]), with angles in radians"
        + (" (math.radians)." if in_degrees else "."),
    )


def _angles_text(rpy: NDArray[np.float64]) -> str:
    """Return the angles that are not 0, in degrees."""
    pairs = zip(_NAMES, rpy.tolist(), strict=True)
    return ", ".join(f"{name} = {degrees(angle):.3g} degrees" for name, angle in pairs if angle)


def _axis(quaternions: NDArray[np.float64]) -> tuple[str, str]:
    """Return the names of the angle and of the vector part: ("yaw", "z") for rotations about z."""
    used = np.flatnonzero((np.abs(quaternions[:, :3]) > 1e-6).any(axis=0))
    return (_NAMES[used[0]], "xyz"[used[0]]) if len(used) == 1 else ("angle", "the vector x, y, z")


def _angle_of(w: float) -> float:
    return 2.0 * float(np.arccos(np.clip(w, -1.0, 1.0)))


def _fix_text(first: NDArray[np.float64], angle: float) -> str:
    axis, component = _axis(first[None])
    if component not in "xyz":
        direction = first[:3] / np.linalg.norm(first[:3])
        x, y, z = (np.sin(angle / 2.0) * direction).tolist()
        return (
            f"Use half the angle in both: x, y, z = axis * math.sin(angle / 2), w = math.cos(angle / 2). For the angle "
            f"{degrees(angle):.3g} degrees these are x = {x:.6g}, y = {y:.6g}, z = {z:.6g}, "
            f"w = {np.cos(angle / 2.0):.6g}."
        )
    signed = angle if float(first["xyz".index(component)]) >= 0.0 else -angle
    return (
        f"Use half the angle in both: {component} = math.sin({axis} / 2), w = math.cos({axis} / 2). For {axis} = "
        f"{degrees(signed):.3g} degrees these are {_ROTATION_FIELD}{component} = {np.sin(signed / 2.0):.6g} and "
        f"{_ROTATION_FIELD}w = "
        f"{np.cos(signed / 2.0):.6g}."
    )
