# SPDX-License-Identifier: Apache-2.0
"""Operations on unit quaternions (x, y, z, w) as arrays of shape (..., 4), with any leading batch axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import coframe.lazy_numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

Array: TypeAlias = "NDArray[np.float64]"

__all__ = [
    "from_euler",
    "from_matrix",
    "from_rotvec",
    "from_rpy",
    "inverse",
    "multiply",
    "rotate",
    "to_euler",
    "to_matrix",
    "to_rotvec",
    "to_rpy",
]

# Above this |sin(pitch)|, the x axis points straight up or down, and roll and yaw rotate about the same axis.
_GIMBAL_LOCK = 1.0 - 1e-12
# Below this sine of half an angle, two axes of Euler angles are the same.
_EULER_GIMBAL_LOCK = 1e-12


def multiply(a: Array, b: Array) -> Array:
    """Return the Hamilton product a b: the rotation b, then the rotation a. Shapes (..., 4) are broadcast."""
    ax, ay, az, aw = np.moveaxis(a, -1, 0)
    bx, by, bz, bw = np.moveaxis(b, -1, 0)
    return np.stack(
        (
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        ),
        axis=-1,
    )


def inverse(q: Array) -> Array:
    """Return the inverse rotation, which for a unit quaternion is its conjugate. Shape (..., 4)."""
    return np.concatenate((-q[..., :3], q[..., 3:]), axis=-1)


def rotate(q: Array, v: Array) -> Array:
    """Return vectors (..., 3) rotated by q (..., 4), broadcast: v + 2 w (u x v) + 2 u x (u x v)."""
    u, w = q[..., :3], q[..., 3:]
    t = 2.0 * np.cross(u, v)
    return v + w * t + np.cross(u, t)


def to_matrix(q: Array) -> Array:
    """Return the rotation matrices, shape (..., 3, 3)."""
    x, y, z, w = np.moveaxis(q, -1, 0)
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def from_matrix(matrix: Array) -> Array:
    """Return the unit quaternions (..., 4) of rotation matrices (..., 3, 3), with w >= 0.

    Uses the column of 4 q q^T with the largest diagonal element, which avoids division by a small number
    (Shepperd, 1978).
    """
    m = np.asarray(matrix, dtype=np.float64)
    d = np.diagonal(m, axis1=-2, axis2=-1)
    trace = d.sum(axis=-1)
    products = np.empty((*m.shape[:-2], 4, 4))
    for i in range(3):
        products[..., i, i] = 1.0 + 2.0 * d[..., i] - trace
        for j in range(i):
            products[..., i, j] = products[..., j, i] = m[..., i, j] + m[..., j, i]
    products[..., 3, 3] = 1.0 + trace
    products[..., 3, 0] = products[..., 0, 3] = m[..., 2, 1] - m[..., 1, 2]
    products[..., 3, 1] = products[..., 1, 3] = m[..., 0, 2] - m[..., 2, 0]
    products[..., 3, 2] = products[..., 2, 3] = m[..., 1, 0] - m[..., 0, 1]
    largest = np.diagonal(products, axis1=-2, axis2=-1).argmax(axis=-1)
    q: Array = np.take_along_axis(products, largest[..., None, None], axis=-2)[..., 0, :]
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    canonical: Array = np.where(q[..., 3:] < 0.0, -q, q)
    return canonical


def from_rpy(rpy: Array) -> Array:
    """Return the quaternions (..., 4) of roll, pitch, yaw (..., 3) in radians about fixed x, y, z (REP 103)."""
    (sr, sp, sy), (cr, cp, cy) = np.moveaxis(np.sin(rpy / 2), -1, 0), np.moveaxis(np.cos(rpy / 2), -1, 0)
    return np.stack(
        (
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        ),
        axis=-1,
    )


def to_rpy(q: Array) -> Array:
    """Return roll, pitch, yaw (..., 3) in radians, with pitch in [-pi/2, pi/2]. At gimbal lock yaw is 0, as in tf2."""
    m = to_matrix(q)
    locked = np.abs(m[..., 2, 0]) >= _GIMBAL_LOCK
    pitch = np.arcsin(np.clip(-m[..., 2, 0], -1.0, 1.0))
    roll = np.where(locked, np.arctan2(-m[..., 1, 2], m[..., 1, 1]), np.arctan2(m[..., 2, 1], m[..., 2, 2]))
    yaw = np.where(locked, 0.0, np.arctan2(m[..., 1, 0], m[..., 0, 0]))
    return np.stack((roll, pitch, yaw), axis=-1) + 0.0  # Adding 0 turns -0 into 0.


def from_rotvec(rotvec: Array) -> Array:
    """Return the quaternions (..., 4) of rotation vectors (..., 3): the axis times the angle in radians."""
    angle = np.linalg.norm(rotvec, axis=-1, keepdims=True)
    # sin(a / 2) / a; NumPy's sinc(x) is sin(pi x) / (pi x), and exact at 0.
    return np.concatenate((0.5 * np.sinc(angle / (2.0 * np.pi)) * rotvec, np.cos(0.5 * angle)), axis=-1)


def to_rotvec(q: Array) -> Array:
    """Return the rotation vectors (..., 3) of rotations by at most half a turn."""
    q = np.where(q[..., 3:] < 0.0, -q, q)
    length = np.linalg.norm(q[..., :3], axis=-1, keepdims=True)
    turns = length > 0.0
    angle = 2.0 * np.arctan2(length, q[..., 3:])
    vectors: Array = np.where(turns, angle / np.where(turns, length, 1.0), 2.0) * q[..., :3]
    return vectors


def from_euler(seq: str, angles: Array) -> Array:
    """Return the quaternions (..., 4) of Euler angles (..., n) in radians, for a sequence of n axes.

    Capital letters are rotations about the axes of the moved frame, small letters about fixed axes, as in SciPy.

    Raises:
        ValueError: ``seq`` is not one to three axes such as "ZYX" or "xyz".
    """
    axes, intrinsic = _axes(seq)
    q: Array = np.zeros((*angles.shape[:-1], 4))
    q[..., 3] = 1.0
    for i, axis in enumerate(axes):
        axis_rotation = np.zeros_like(q)
        axis_rotation[..., axis], axis_rotation[..., 3] = np.sin(angles[..., i] / 2), np.cos(angles[..., i] / 2)
        q = multiply(q, axis_rotation) if intrinsic else multiply(axis_rotation, q)
    return q


def to_euler(q: Array, seq: str) -> Array:
    """Return Euler angles (..., 3) in radians. See :func:`from_euler`.

    After E. Bernardes and S. Viollet, "Quaternion to Euler angles conversion: a direct, general and computationally
    efficient method" (2022). In gimbal lock, the last angle is 0.

    Raises:
        ValueError: ``seq`` is not three axes, or two that follow each other are the same.
    """
    axes, intrinsic = _axes(seq)
    if len(axes) != 3 or axes[0] == axes[1] or axes[1] == axes[2]:
        raise ValueError(f"seq must be three axes without equal neighbors, such as 'ZYX' or 'xyz', not {seq!r}")
    i, j, k = reversed(axes) if intrinsic else axes
    is_symmetric = i == k
    k = 3 - i - j if is_symmetric else k
    sign = (i - j) * (j - k) * (k - i) / 2
    if is_symmetric:
        a, b, c, d = q[..., 3], q[..., i], q[..., j], q[..., k] * sign
    else:
        a, b = q[..., 3] - q[..., j], q[..., i] + q[..., k] * sign
        c, d = q[..., j] + q[..., 3], q[..., k] * sign - q[..., i]
    low, high = np.hypot(c, d), np.hypot(a, b)
    middle = 2.0 * np.arctan2(low, high)
    half_sum, half_difference = np.arctan2(b, a), np.arctan2(d, c)
    first, last = half_sum - half_difference, half_sum + half_difference
    if intrinsic:  # the angles of fixed axes in reverse order
        first, last = last, first
    one_axis = np.where(high < _EULER_GIMBAL_LOCK, 2.0 * half_difference * (1 if intrinsic else -1), 2.0 * half_sum)
    is_locked = (low < _EULER_GIMBAL_LOCK) | (high < _EULER_GIMBAL_LOCK)
    first, last = np.where(is_locked, one_axis, first), np.where(is_locked, 0.0, last)
    if not is_symmetric:
        first, last = (first * sign, last) if intrinsic else (first, last * sign)
        middle = middle - np.pi / 2
    angles = (first, middle, last)
    stacked = np.stack(angles, axis=-1)
    wrapped: Array = stacked - 2.0 * np.pi * np.round(stacked / (2.0 * np.pi))
    return wrapped + 0.0  # Adding 0 turns -0 into 0.


def _axes(seq: str) -> tuple[list[int], bool]:
    """Return the numbers of the axes, and whether they move with the frame."""
    is_known = 1 <= len(seq) <= 3 and (set(seq) <= set("xyz") or set(seq) <= set("XYZ"))
    if not is_known:
        raise ValueError(
            f"seq must be one to three axes, all upper-case (axes of the moved frame) or all lower-case (fixed "
            f"axes), such as 'ZYX' or "
            f"'xyz', not {seq!r}"
        )
    return ["xyz".index(axis) for axis in seq.lower()], seq.isupper()


def __dir__() -> list[str]:
    return sorted(__all__)
