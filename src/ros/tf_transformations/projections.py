# SPDX-License-Identifier: Apache-2.0
"""Projections, shears, view volumes, and matrices that map points to points."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tf_transformations.vectors import unit_direction

Array = NDArray[np.float64]

_EPSILON = 4.0 * float(np.finfo(np.float64).eps)
_TOLERANCE = 1e-8


def projection_matrix(
    point: ArrayLike,
    normal: ArrayLike,
    direction: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
    pseudo: bool = False,
) -> Array:
    """Return the matrix of a projection onto a plane.

    Args:
        point: Point of the plane.
        normal: Normal of the plane.
        direction: Direction of a parallel projection. None for the direction of the normal, if there is no
        `perspective`.
        perspective: Center of a perspective projection.
        pseudo: Whether a perspective projection keeps the order of depths.
    """
    origin = np.asarray(point, dtype=np.float64)[:3]
    unit = unit_direction(normal)
    matrix = np.eye(4)
    if perspective is not None:
        center = np.asarray(perspective, dtype=np.float64)[:3]
        matrix[:3, :3] = np.dot(center - origin, unit) * np.eye(3) - np.outer(center, unit)
        matrix[:3, 3] = np.dot(origin, unit) * center
        if pseudo:
            matrix[:3, :3] -= np.outer(unit, unit)
            matrix[:3, 3] += np.dot(origin, unit) * unit
        matrix[3, :3] = -unit
        matrix[3, 3] = np.dot(center, unit)
        return matrix
    along = unit if direction is None else np.asarray(direction, dtype=np.float64)[:3]
    along = along / np.dot(along, unit)
    matrix[:3, :3] -= np.outer(along, unit)
    matrix[:3, 3] = np.dot(origin, unit) * along
    return matrix


def projection_from_matrix(
    matrix: ArrayLike, pseudo: bool = False
) -> tuple[Array, Array, Array | None, Array | None, bool]:
    """Return the arguments of `projection_matrix`, with a homogeneous point.

    Raises:
        ValueError: The matrix is not a projection.
    """
    m = np.asarray(matrix, dtype=np.float64)
    values, vectors = np.linalg.eig(m)
    fixed = np.flatnonzero(np.abs(np.real(values) - 1.0) < _TOLERANCE)
    if not pseudo and len(fixed):
        point = np.real(vectors[:, fixed[-1]])
        direction = _null_vector(m[:3, :3])
        normal = _null_vector(m[:3, :3].T)
        if direction is None:
            raise ValueError("no eigenvector corresponding to eigenvalue 0")
        if normal is None:
            return point / point[3], direction, None, None, False
        return point / point[3], normal, direction, None, False
    seen = np.flatnonzero(np.abs(np.real(values)) > _TOLERANCE)
    if not len(seen):
        raise ValueError("no eigenvector not corresponding to eigenvalue 0")
    point = np.real(vectors[:, seen[-1]])
    point = point / point[3]
    normal = -m[3, :3]
    center = m[:3, 3] / np.dot(point[:3], normal)
    return point, normal, None, center - normal if pseudo else center, pseudo


def clip_matrix(
    left: float, right: float, bottom: float, top: float, near: float, far: float, perspective: bool = False
) -> Array:
    """Return the matrix from the coordinates of a view volume to those from -1 to 1.

    Args:
        left: Limit along x.
        right: Limit along x.
        bottom: Limit along y.
        top: Limit along y.
        near: Limit along z.
        far: Limit along z.
        perspective: Whether the volume is a truncated pyramid, whose limits along x and y are those at `near`.

    Raises:
        ValueError: A limit is not less than the opposite one, or `near` is not positive in a perspective view.
    """
    if left >= right or bottom >= top or near >= far:
        raise ValueError("invalid frustum: each lower limit must be less than the upper limit")
    width, height, depth = right - left, top - bottom, far - near
    if not perspective:
        matrix = np.diag([2.0 / width, 2.0 / height, 2.0 / depth, 1.0])
        matrix[:3, 3] = -(right + left) / width, -(top + bottom) / height, -(far + near) / depth
        return matrix
    if near <= _EPSILON:
        raise ValueError("invalid frustum: near <= 0")
    return np.array(
        [
            [-2.0 * near / width, 0.0, (right + left) / width, 0.0],
            [0.0, -2.0 * near / height, (top + bottom) / height, 0.0],
            [0.0, 0.0, -(far + near) / depth, 2.0 * near * far / depth],
            [0.0, 0.0, -1.0, 0.0],
        ]
    )


def shear_matrix(angle: float, direction: ArrayLike, point: ArrayLike, normal: ArrayLike) -> Array:
    """Return the matrix of a shear by an angle along a direction, which does not move the points of a plane.

    Args:
        angle: Angle by which the normal is tilted.
        direction: Direction of the shear, perpendicular to the normal.
        point: Point of the plane.
        normal: Normal of the plane.

    Raises:
        ValueError: The direction is not perpendicular to the normal.
    """
    across, along = unit_direction(normal), unit_direction(direction)
    if abs(np.dot(across, along)) > 1e-6:
        raise ValueError("direction and normal vectors are not orthogonal")
    slope = math.tan(angle)
    matrix = np.eye(4)
    matrix[:3, :3] += slope * np.outer(along, across)
    matrix[:3, 3] = -slope * np.dot(np.asarray(point, dtype=np.float64)[:3], across) * along
    return matrix


def shear_from_matrix(matrix: ArrayLike) -> tuple[float, Array, Array, Array]:
    """Return the arguments of `shear_matrix`, with a homogeneous point.

    Raises:
        ValueError: The matrix is not a shear.
    """
    m = np.asarray(matrix, dtype=np.float64)
    # The matrix minus the identity has rank one: slope * outer(direction, normal).
    directions, sizes, normals = np.linalg.svd(m[:3, :3] - np.eye(3))
    direction, slope, normal = directions[:, 0], float(sizes[0]), normals[0]
    if slope < _EPSILON or sizes[1] > _TOLERANCE * max(1.0, slope) or abs(direction @ normal) > _TOLERANCE:
        raise ValueError("The matrix is not a shear: it moves points of more than one plane, or none.")
    point = np.append(-(m[:3, 3] @ direction) / slope * normal, 1.0)
    return math.atan(slope), direction, point, normal


def orthogonalization_matrix(lengths: ArrayLike, angles: ArrayLike) -> Array:
    """Return the matrix from the coordinates of a crystal's cell to Cartesian coordinates.

    Args:
        lengths: Lengths a, b and c of the edges.
        angles: Angles alpha, beta and gamma between the edges in degrees.
    """
    a, b, c = np.asarray(lengths, dtype=np.float64)
    alpha, beta, gamma = np.radians(np.asarray(angles, dtype=np.float64))
    skew = (math.cos(alpha) * math.cos(beta) - math.cos(gamma)) / (math.sin(alpha) * math.sin(beta))
    matrix = np.eye(4)
    matrix[0, 0] = a * math.sin(beta) * math.sqrt(1.0 - skew * skew)
    matrix[1, :2] = -a * math.sin(beta) * skew, b * math.sin(alpha)
    matrix[2, :3] = a * math.cos(beta), b * math.cos(alpha), c
    return matrix


def superimposition_matrix(v0: ArrayLike, v1: ArrayLike, scaling: bool = False, usesvd: bool = True) -> Array:
    """Return the rotation and translation that move points to others with the least sum of squared distances.

    Args:
        v0: Points, shape (3, N) or homogeneous (4, N).
        v1: The points to which they are moved, of the same shape.
        scaling: Whether the matrix may also scale.
        usesvd: Ignored, accepted for compatibility: Kabsch's algorithm is used, with a singular value
            decomposition.
    """
    del usesvd
    first, second = (np.asarray(v, dtype=np.float64)[:3] for v in (v0, v1))
    center0, center1 = first.mean(axis=1), second.mean(axis=1)
    first, second = first - center0[:, None], second - center1[:, None]
    u, _, vt = np.linalg.svd(second @ first.T)
    mirrored = np.diag([1.0, 1.0, np.linalg.det(u @ vt)])
    linear = u @ mirrored @ vt
    if scaling:
        linear = linear * math.sqrt(float(np.sum(second * second) / np.sum(first * first)))
    matrix = np.eye(4)
    matrix[:3, :3] = linear
    matrix[:3, 3] = center1 - linear @ center0
    return matrix


def _null_vector(linear: Array) -> Array | None:
    """Return a unit eigenvector of the eigenvalue 0, or None."""
    values, vectors = np.linalg.eig(linear)
    match = np.flatnonzero(np.abs(np.real(values)) < _TOLERANCE)
    if not len(match):
        return None
    vector = np.real(vectors[:, match[0]])
    return np.asarray(vector / np.linalg.norm(vector))
