# SPDX-License-Identifier: Apache-2.0
"""Rotation of objects with a pointer, as if a ball around the object were turned."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tf_transformations.quaternions import (
    quaternion_from_matrix,
    quaternion_matrix,
    quaternion_multiply,
    quaternion_slerp,
)
from tf_transformations.vectors import unit_direction

Array = NDArray[np.float64]

_EPSILON = 4.0 * float(np.finfo(np.float64).eps)


class Arcball:
    """A virtual ball that is turned by dragging.

    Args:
        initial: Rotation at the beginning as a quaternion (x, y, z, w) or 4x4 matrix. None: no rotation.

    Raises:
        ValueError: The rotation is neither.
    """

    def __init__(self, initial: ArrayLike | None = None) -> None:
        self._axes: list[Array] | None = None
        self._axis: Array | None = None
        self._radius = 1.0
        self._center = (0.0, 0.0)
        self._vdown = np.array([0.0, 0.0, 1.0])
        self._constrain = False
        rotation = np.array([0.0, 0.0, 0.0, 1.0] if initial is None else initial, dtype=np.float64)
        if rotation.shape == (4, 4):
            rotation = quaternion_from_matrix(rotation)
        elif rotation.shape != (4,):
            raise ValueError("initial not a quaternion or matrix.")
        self._qnow = self._qpre = self._qdown = rotation / np.linalg.norm(rotation)

    def place(self, center: Sequence[float], radius: float) -> None:
        """Place the ball, for example when the size of the window changes.

        Args:
            center: Center in pixels.
            radius: Radius in pixels.
        """
        self._radius = float(radius)
        self._center = (float(center[0]), float(center[1]))

    def setaxes(self, *axes: ArrayLike) -> None:
        """Set the axes to which rotations can be constrained."""
        self._axes = [unit_direction(axis) for axis in axes]

    def setconstrain(self, constrain: bool) -> None:
        """Set whether rotations are constrained to the nearest axis."""
        self._constrain = bool(constrain)

    def getconstrain(self) -> bool:
        """Return whether rotations are constrained to the nearest axis."""
        return self._constrain

    def down(self, point: Sequence[float]) -> None:
        """Begin to drag at a pixel."""
        self._vdown = arcball_map_to_sphere(point, self._center, self._radius)
        self._qdown = self._qpre = self._qnow
        self._axis = None
        if self._constrain and self._axes:
            self._axis = arcball_nearest_axis(self._vdown, self._axes)
            self._vdown = arcball_constrain_to_axis(self._vdown, self._axis)

    def drag(self, point: Sequence[float]) -> None:
        """Turn the ball to a pixel."""
        now = arcball_map_to_sphere(point, self._center, self._radius)
        if self._axis is not None:
            now = arcball_constrain_to_axis(now, self._axis)
        self._qpre = self._qnow
        axis = np.cross(self._vdown, now)
        if np.dot(axis, axis) < _EPSILON:
            self._qnow = self._qdown
        else:
            self._qnow = quaternion_multiply([*axis, np.dot(self._vdown, now)], self._qdown)

    def next(self, acceleration: float = 0.0) -> None:
        """Continue the last rotation.

        Args:
            acceleration: Fraction by which the rotation is larger than the last one.
        """
        further = quaternion_slerp(self._qpre, self._qnow, 2.0 + acceleration)
        self._qpre, self._qnow = self._qnow, further

    def matrix(self) -> Array:
        """Return the rotation as a 4x4 matrix."""
        return quaternion_matrix(self._qnow)


def arcball_map_to_sphere(point: Sequence[float], center: Sequence[float], radius: float) -> Array:
    """Return the unit vector of the point on a ball that is seen at a pixel, or of the closest point of its outline."""
    x, y = (point[0] - center[0]) / radius, (center[1] - point[1]) / radius
    squared = x * x + y * y
    if squared > 1.0:
        return np.array([x, y, 0.0]) / math.sqrt(squared)
    return np.array([x, y, math.sqrt(1.0 - squared)])


def arcball_constrain_to_axis(point: ArrayLike, axis: ArrayLike) -> Array:
    """Return the unit vector closest to a point of the ball that is perpendicular to an axis."""
    v, a = np.array(point, dtype=np.float64), np.asarray(axis, dtype=np.float64)
    v -= a * np.dot(a, v)
    length = float(np.linalg.norm(v))
    if length > _EPSILON:
        return np.asarray(v / (-length if v[2] < 0.0 else length))
    if a[2] == 1.0:
        return np.array([1.0, 0.0, 0.0])
    return unit_direction([-a[1], a[0], 0.0])


def arcball_nearest_axis(point: ArrayLike, axes: Sequence[ArrayLike]) -> Array:
    """Return the axis whose perpendicular plane is closest to a point of the ball."""
    v = np.asarray(point, dtype=np.float64)
    return np.asarray(max(axes, key=lambda axis: float(np.dot(arcball_constrain_to_axis(v, axis), v))))
