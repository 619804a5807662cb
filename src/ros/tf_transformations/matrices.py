# SPDX-License-Identifier: Apache-2.0
"""Homogeneous 4x4 matrices."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tf_transformations.euler import Angles, euler_from_matrix, euler_matrix
from tf_transformations.vectors import unit_direction

Array = NDArray[np.float64]

_EPSILON = 4.0 * float(np.finfo(np.float64).eps)
_TOLERANCE = 1e-8


def identity_matrix() -> Array:
    """Return the 4x4 identity matrix."""
    return np.eye(4)


def translation_matrix(direction: ArrayLike) -> Array:
    """Return the matrix of a translation by a vector."""
    matrix = np.eye(4)
    matrix[:3, 3] = np.asarray(direction, dtype=np.float64)[:3]
    return matrix


def translation_from_matrix(matrix: ArrayLike) -> Array:
    """Return the translation vector of a matrix."""
    return np.array(np.asarray(matrix, dtype=np.float64)[:3, 3])


def inverse_matrix(matrix: ArrayLike) -> Array:
    """Return the inverse of a matrix."""
    return np.linalg.inv(np.asarray(matrix, dtype=np.float64))


def concatenate_matrices(*matrices: ArrayLike) -> Array:
    """Return the product of matrices in the order of the arguments, or the identity without arguments."""
    product = np.eye(4)
    for matrix in matrices:
        product = product @ np.asarray(matrix, dtype=np.float64)
    return product


def is_same_transform(matrix0: ArrayLike, matrix1: ArrayLike) -> bool:
    """Return whether two matrices represent the same transformation, up to a common factor."""
    first, second = (np.asarray(m, dtype=np.float64) for m in (matrix0, matrix1))
    return bool(np.allclose(first / first[3, 3], second / second[3, 3]))


def rotation_matrix(angle: float, direction: ArrayLike, point: ArrayLike | None = None) -> Array:
    """Return the matrix of a rotation by an angle about an axis, through the origin or through a point."""
    x, y, z = unit_direction(direction)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    rotation = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
    return _about(rotation, point)


def rotation_from_matrix(matrix: ArrayLike) -> tuple[float, Array, Array]:
    """Return angle, axis and a homogeneous point of a rotation, the arguments of `rotation_matrix`.

    Raises:
        ValueError: The matrix is not a rotation.
    """
    m = np.asarray(matrix, dtype=np.float64)
    rotation = m[:3, :3]
    axis = _eigenvector(rotation, 1.0, "rotation")
    x, y, z = axis
    cosine = (np.trace(rotation) - 1.0) / 2.0
    antisymmetric = np.array(
        [rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]]
    )
    angle = math.atan2(float(antisymmetric @ np.array([x, y, z])) / 2.0, float(cosine))
    return angle, axis, _fixed_point(m, "rotation")


def reflection_matrix(point: ArrayLike, normal: ArrayLike) -> Array:
    """Return the matrix of a reflection at the plane through a point with a normal."""
    unit = unit_direction(normal)
    return _about(np.eye(3) - 2.0 * np.outer(unit, unit), point)


def reflection_from_matrix(matrix: ArrayLike) -> tuple[Array, Array]:
    """Return a homogeneous point and the normal of the plane of a reflection, the arguments of `reflection_matrix`.

    Raises:
        ValueError: The matrix is not a reflection.
    """
    m = np.asarray(matrix, dtype=np.float64)
    normal = _eigenvector(m[:3, :3], -1.0, "reflection")
    return _fixed_point(m, "reflection"), normal


def scale_matrix(factor: float, origin: ArrayLike | None = None, direction: ArrayLike | None = None) -> Array:
    """Return the matrix of a scaling by a factor about an origin, in all directions or in one direction."""
    if direction is None:
        return _about(factor * np.eye(3), origin)
    unit = unit_direction(direction)
    return _about(np.eye(3) - (1.0 - factor) * np.outer(unit, unit), origin)


def scale_from_matrix(matrix: ArrayLike) -> tuple[float, Array, Array | None]:
    """Return factor, homogeneous origin and direction of a scaling, the arguments of `scale_matrix`.

    Raises:
        ValueError: The matrix is not a scaling.
    """
    m = np.asarray(matrix, dtype=np.float64)
    linear = m[:3, :3]
    factor = float(np.trace(linear)) - 2.0
    values = np.linalg.eigvals(linear)
    if np.any(np.abs(values - factor) < _TOLERANCE):
        return factor, _fixed_point(m, "scaling"), _eigenvector(linear, factor, "scaling")
    return (factor + 2.0) / 3.0, _fixed_point(m, "scaling"), None


def compose_matrix(
    scale: ArrayLike | None = None,
    shear: ArrayLike | None = None,
    angles: ArrayLike | None = None,
    translate: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
) -> Array:
    """Return the product of perspective, translation, rotation (`sxyz`), shear and scaling. All parts are optional.

    Args:
        scale: Factors along x, y and z.
        shear: Factors for x-y, x-z and y-z.
        angles: Roll, pitch and yaw in radians.
        translate: Translation vector.
        perspective: Last row of the matrix.
    """
    matrix = np.eye(4)
    if perspective is not None:
        matrix[3, :] = np.asarray(perspective, dtype=np.float64)[:4]
    if translate is not None:
        matrix = matrix @ translation_matrix(translate)
    if angles is not None:
        roll, pitch, yaw = np.asarray(angles, dtype=np.float64)
        matrix = matrix @ euler_matrix(roll, pitch, yaw)
    if shear is not None:
        sheared = np.eye(4)
        sheared[0, 1], sheared[0, 2], sheared[1, 2] = np.asarray(shear, dtype=np.float64)
        matrix = matrix @ sheared
    if scale is not None:
        matrix = matrix @ np.diag([*np.asarray(scale, dtype=np.float64), 1.0])
    return np.asarray(matrix / matrix[3, 3])


def decompose_matrix(matrix: ArrayLike) -> tuple[Array, list[float], Angles, Array, Array]:
    """Return scale, shear, angles, translation and perspective, the arguments of `compose_matrix`.

    Raises:
        ValueError: The matrix is singular.
    """
    m = np.asarray(matrix, dtype=np.float64)
    if abs(m[3, 3]) < _EPSILON:
        raise ValueError("M[3, 3] is zero")
    m = m / m[3, 3]
    affine = np.vstack([m[:3], [0.0, 0.0, 0.0, 1.0]])
    if abs(np.linalg.det(affine)) < _EPSILON:
        raise ValueError("matrix is singular")
    perspective = np.array([0.0, 0.0, 0.0, 1.0])
    if np.any(np.abs(m[3, :3]) > _EPSILON):
        perspective = m[3] @ np.linalg.inv(affine)
    rotation, triangular = np.linalg.qr(affine[:3, :3])
    signs = np.where(np.diag(triangular) < 0.0, -1.0, 1.0)
    rotation, triangular = rotation * signs, triangular * signs[:, None]
    if np.linalg.det(rotation) < 0.0:
        # The sign of a reflection is moved to the scaling, so that the remaining matrix is a rotation.
        rotation, triangular = -rotation, -triangular
    scale = np.diag(triangular).copy()
    sheared = triangular / scale
    shear = [float(sheared[0, 1]), float(sheared[0, 2]), float(sheared[1, 2])]
    return scale, shear, euler_from_matrix(rotation), affine[:3, 3].copy(), perspective


def _about(linear: Array, point: ArrayLike | None) -> Array:
    """Return the 4x4 matrix of a 3x3 matrix that is applied about a point, which it does not move."""
    matrix = np.eye(4)
    matrix[:3, :3] = linear
    if point is not None:
        fixed = np.asarray(point, dtype=np.float64)[:3]
        matrix[:3, 3] = fixed - linear @ fixed
    return matrix


def _eigenvector(linear: Array, value: float, kind: str) -> Array:
    """Return the unit eigenvector of an eigenvalue."""
    values, vectors = np.linalg.eig(linear)
    match = np.flatnonzero(np.abs(values - value) < _TOLERANCE)
    if not len(match):
        raise ValueError(f"The matrix is not a {kind}. It has no eigenvalue {value:g}.")
    vector = np.real(vectors[:, match[-1]])
    return np.asarray(vector / np.linalg.norm(vector))


def _fixed_point(matrix: Array, kind: str) -> Array:
    """Return a homogeneous point that the matrix does not move."""
    values, vectors = np.linalg.eig(matrix)
    match = np.flatnonzero(np.abs(values - 1.0) < _TOLERANCE)
    with_weight = [index for index in match if abs(vectors[3, index]) > _EPSILON]
    if not with_weight:
        raise ValueError(f"The matrix is not a {kind}. It has no fixed point.")
    point = np.real(vectors[:, with_weight[-1]])
    return np.asarray(point / point[3])
