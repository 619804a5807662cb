# SPDX-License-Identifier: Apache-2.0
"""Quaternions (x, y, z, w)."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tf_transformations.vectors import unit_direction

Array = NDArray[np.float64]

_EPSILON = 4.0 * float(np.finfo(np.float64).eps)


def quaternion_about_axis(angle: float, axis: ArrayLike) -> Array:
    """Return the quaternion of a rotation by an angle about an axis."""
    return np.append(math.sin(angle / 2.0) * unit_direction(axis), math.cos(angle / 2.0))


def quaternion_multiply(quaternion1: ArrayLike, quaternion0: ArrayLike) -> Array:
    """Return the product, which is the rotation `quaternion0` followed by `quaternion1`."""
    x1, y1, z1, w1 = np.asarray(quaternion1, dtype=np.float64)
    x0, y0, z0, w0 = np.asarray(quaternion0, dtype=np.float64)
    return np.array(
        [
            w1 * x0 + x1 * w0 + y1 * z0 - z1 * y0,
            w1 * y0 - x1 * z0 + y1 * w0 + z1 * x0,
            w1 * z0 + x1 * y0 - y1 * x0 + z1 * w0,
            w1 * w0 - x1 * x0 - y1 * y0 - z1 * z0,
        ]
    )


def quaternion_conjugate(quaternion: ArrayLike) -> Array:
    """Return the conjugate of a quaternion."""
    x, y, z, w = np.asarray(quaternion, dtype=np.float64)
    return np.array([-x, -y, -z, w])


def quaternion_inverse(quaternion: ArrayLike) -> Array:
    """Return the inverse of a quaternion, which need not be normalized but must not be zero."""
    q = np.asarray(quaternion, dtype=np.float64)
    return quaternion_conjugate(q) / (q @ q)


def quaternion_matrix(quaternion: ArrayLike) -> Array:
    """Return the 4x4 rotation matrix of a quaternion, which is normalized. Zero becomes the identity."""
    q = np.array(quaternion, dtype=np.float64)[:4]
    matrix = np.eye(4)
    squared = float(q @ q)
    if squared < _EPSILON:
        return matrix
    x, y, z, w = q.tolist()
    s = 2.0 / squared
    matrix[:3, :3] = [
        [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
        [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
        [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
    ]
    return matrix


def quaternion_from_matrix(matrix: ArrayLike) -> Array:
    """Return the unit quaternion with w >= 0 of a rotation matrix (3x3 or 4x4).

    Division by the largest component avoids a loss of precision.
    """
    m = np.asarray(matrix, dtype=np.float64)[:3, :3]
    trace = float(np.trace(m))
    q = np.empty(4)
    largest = int(np.argmax([m[0, 0], m[1, 1], m[2, 2], trace]))
    if largest == 3:
        q[:] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 1.0 + trace
    else:
        i, j, k = largest, (largest + 1) % 3, (largest + 2) % 3
        q[i] = 1.0 - trace + 2.0 * m[i, i]
        q[j] = m[j, i] + m[i, j]
        q[k] = m[k, i] + m[i, k]
        q[3] = m[k, j] - m[j, k]
    q /= np.linalg.norm(q)
    return -q if q[3] < 0.0 else q


def quaternion_slerp(
    quat0: ArrayLike, quat1: ArrayLike, fraction: float, spin: int = 0, shortestpath: bool = True
) -> Array:
    """Return the spherical linear interpolation between two quaternions.

    Args:
        quat0: Quaternion at fraction 0.
        quat1: Quaternion at fraction 1.
        fraction: Fraction of the interpolation.
        spin: Number of additional half turns.
        shortestpath: Whether to use the shorter rotation, even if the quaternions have opposite signs.
    """
    first, last = (np.asarray(q, dtype=np.float64) / np.linalg.norm(q) for q in (quat0, quat1))
    if fraction in (0.0, 1.0):
        return np.array(last if fraction else first)
    cosine = float(first @ last)
    if abs(abs(cosine) - 1.0) < _EPSILON:
        return np.array(first)
    if shortestpath and cosine < 0.0:
        cosine, last = -cosine, -last
    angle = math.acos(cosine) + spin * math.pi
    if abs(angle) < _EPSILON:
        return np.array(first)
    weights = math.sin((1.0 - fraction) * angle), math.sin(fraction * angle)
    return np.asarray((weights[0] * first + weights[1] * last) / math.sin(angle))


def random_quaternion(rand: ArrayLike | None = None) -> Array:
    """Return a uniformly distributed random unit quaternion.

    Args:
        rand: Three random numbers in [0, 1). None: they are generated.
    """
    u = np.random.default_rng().random(3) if rand is None else np.asarray(rand, dtype=np.float64)
    near, far = math.sqrt(1.0 - u[0]), math.sqrt(u[0])
    first, second = 2.0 * math.pi * u[1], 2.0 * math.pi * u[2]
    return np.array([near * math.sin(first), near * math.cos(first), far * math.sin(second), far * math.cos(second)])


def random_rotation_matrix(rand: ArrayLike | None = None) -> Array:
    """Return the 4x4 matrix of a random rotation. The argument is the same as for `random_quaternion`."""
    return quaternion_matrix(random_quaternion(rand))
