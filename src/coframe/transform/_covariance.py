# SPDX-License-Identifier: Apache-2.0
"""Covariances of poses in other frames.

A covariance has the layout of ROS's PoseWithCovariance: (6, 6), or 36 numbers in row-major order, over x, y, z in
meters and small rotations about the fixed axes x, y, z in radians, all expressed in the frame of the pose.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def transform_covariance(
    rotation: Array, position: Array, covariance: ArrayLike, own_covariance: ArrayLike | None = None
) -> Array:
    """Return the covariance of ``transform @ pose``, to first order.

    With R the rotation of the transform and a = R p the rotated position of the pose: position and rotation errors of
    the pose are rotated by R, and the errors (dt, w) of the transform itself add dt + w x a to the position and w to
    the rotation (T. Barfoot, "State Estimation for Robotics", section on compounding uncertain poses, with errors about
    fixed axes).

    Args:
        rotation: Rotation matrix of the transform, shape (..., 3, 3).
        position: Position of the pose in the source frame, in meters, shape (..., 3).
        covariance: Covariance of the pose, shape (..., 6, 6) or (..., 36).
        own_covariance: Covariance of the transform itself, in the same shapes; None if it is exactly known.

    Returns:
        The covariance in the shape of `covariance`.

    Raises:
        ValueError: A covariance has another shape.
    """
    given = np.asarray(covariance, dtype=np.float64)
    both = np.zeros((*rotation.shape[:-2], 6, 6))
    both[..., :3, :3] = both[..., 3:, 3:] = rotation
    result = both @ _square(given, "covariance") @ np.swapaxes(both, -1, -2)
    if own_covariance is not None:
        arm = (rotation @ position[..., None])[..., 0]
        lever = np.zeros((*arm.shape[:-1], 6, 6))
        lever[..., range(6), range(6)] = 1.0
        lever[..., :3, 3:] = -_cross(arm)
        result = result + lever @ _square(own_covariance, "own_covariance") @ np.swapaxes(lever, -1, -2)
    return result.reshape(*result.shape[:-2], 36) if given.shape[-2:] != (6, 6) else result


def _square(values: ArrayLike, name: str) -> Array:
    array = np.asarray(values, dtype=np.float64)
    if array.shape[-2:] == (6, 6):
        return array
    if array.ndim and array.shape[-1] == 36:
        return array.reshape(*array.shape[:-1], 6, 6)
    raise ValueError(f"{name} must have shape (..., 6, 6) or (..., 36), not {array.shape}")


def _cross(vectors: Array) -> Array:
    """Return the matrices whose product with u is the cross product of the vectors and u."""
    matrix = np.zeros((*vectors.shape, 3))
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    matrix[..., 0, 1], matrix[..., 0, 2] = -z, y
    matrix[..., 1, 0], matrix[..., 1, 2] = z, -x
    matrix[..., 2, 0], matrix[..., 2, 1] = -y, x
    return matrix
