# SPDX-License-Identifier: Apache-2.0
"""Euler angles in all 24 conventions.

Rotations about body axes are equivalent to rotations about fixed axes in the opposite order. All computations therefore
use fixed ("static") axes i, j, k: the matrix is R_k(ak) R_j(aj) R_i(ai).
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tf_transformations.quaternions import (
    quaternion_about_axis,
    quaternion_matrix,
    quaternion_multiply,
)

Array = NDArray[np.float64]
Angles = tuple[float, float, float]

_EPSILON = 4.0 * float(np.finfo(np.float64).eps)


@dataclass(frozen=True)
class _Axes:
    """A convention: three fixed axes, and whether the order of the angles is reversed."""

    i: int
    j: int
    k: int
    reverse: bool

    @property
    def third(self) -> int:
        """The axis that is neither the first nor the second."""
        return 3 - self.i - self.j

    @property
    def sign(self) -> float:
        """1 if the first, second and third axis form a right-handed system, otherwise -1."""
        return 1.0 if (self.j - self.i) % 3 == 1 else -1.0


def _parse(axes: str) -> _Axes:
    kind, names = axes[:1], axes[1:]
    numbers = ["xyz".find(name) for name in names]
    well_formed = kind in {"s", "r"} and len(names) == 3 and -1 not in numbers
    if not well_formed or numbers[1] in (numbers[0], numbers[2]):
        raise ValueError(
            f"Invalid axes {axes!r}. Expected 's' or 'r' and three axes of which no two consecutive ones are equal, "
            "for example 'sxyz' or 'rzyx'."
        )
    reverse = kind == "r"
    i, j, k = reversed(numbers) if reverse else numbers
    return _Axes(i, j, k, reverse)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Array:
    """Return the quaternion of three Euler angles, by default roll, pitch and yaw.

    Args:
        ai: First angle in radians.
        aj: Second angle in radians.
        ak: Third angle in radians.
        axes: Convention of the angles.
    """
    convention = _parse(axes)
    angles = (ak, aj, ai) if convention.reverse else (ai, aj, ak)
    unit = np.eye(3)
    first, second, third = (
        quaternion_about_axis(angle, unit[axis])
        for angle, axis in zip(angles, (convention.i, convention.j, convention.k), strict=True)
    )
    return quaternion_multiply(third, quaternion_multiply(second, first))


def euler_matrix(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Array:
    """Return the 4x4 rotation matrix of three Euler angles, with the arguments of `quaternion_from_euler`."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def euler_from_matrix(matrix: ArrayLike, axes: str = "sxyz") -> Angles:
    """Return the three Euler angles of a rotation matrix (3x3 or 4x4).

    In gimbal lock, where the first and the last axis coincide, the last angle about the fixed axes is 0.
    """
    convention = _parse(axes)
    rotation = np.asarray(matrix, dtype=np.float64)[:3, :3]
    angles = (_proper_euler_angles if convention.i == convention.k else _distinct)(rotation, convention)
    return angles[::-1] if convention.reverse else angles


def euler_from_quaternion(quaternion: ArrayLike, axes: str = "sxyz") -> Angles:
    """Return the three Euler angles of a quaternion (x, y, z, w), by default roll, pitch and yaw."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)


def _distinct(m: Array, axes: _Axes) -> Angles:
    """Return the angles about three different axes (Tait-Bryan)."""
    i, j, k, sign = axes.i, axes.j, axes.k, axes.sign
    cosine = math.hypot(m[i, i], m[j, i])
    second = math.atan2(-sign * m[k, i], cosine)
    if cosine > _EPSILON:
        return math.atan2(sign * m[k, j], m[k, k]), second, math.atan2(sign * m[j, i], m[i, i])
    return math.atan2(-sign * m[j, k], m[j, j]), second, 0.0


def _proper_euler_angles(m: Array, axes: _Axes) -> Angles:
    """Return the angles of a convention whose first and last axis are equal (proper Euler).

    There are two solutions. As in `transforms3d`, the second angle has the sign of the axes.
    """
    i, j, third, sign = axes.i, axes.j, axes.third, axes.sign
    sine = math.hypot(m[i, j], m[i, third])
    second = sign * math.atan2(sine, m[i, i])
    if sine > _EPSILON:
        return sign * math.atan2(m[i, j], m[i, third]), second, sign * math.atan2(m[j, i], -m[third, i])
    return sign * math.atan2(-m[j, third], m[j, j]), second, 0.0
