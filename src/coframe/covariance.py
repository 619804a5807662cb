"""How sure a pose is, seen from another frame.

A covariance is that of ROS's PoseWithCovariance: (6, 6) or its 36 numbers row by row, over x, y, z in metres and small
turns about the fixed axes x, y, z in radians, all in the frame that the pose is told in.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from coframe.transform import Transform

Array = NDArray[np.float64]


def transform_covariance(
    transform: Transform, pose: Transform, covariance: ArrayLike, own_covariance: ArrayLike | None = None
) -> Array:
    """The covariance of `transform @ pose` to first order.

    With R the transform's rotation and a = R p the pose's arm: position and turn are rotated by R, and the transform's
    own errors (dt, w) add dt + w x a to the position and w to the turn (T. Barfoot, "State Estimation for Robotics",
    section on compounding uncertain poses, with errors about fixed axes).
    """
    given = np.asarray(covariance, dtype=np.float64)
    rotation = transform.rotation
    both = np.zeros((*rotation.shape[:-2], 6, 6))
    both[..., :3, :3] = both[..., 3:, 3:] = rotation
    result = both @ _square(given, "the covariance") @ np.swapaxes(both, -1, -2)
    if own_covariance is not None:
        arm = (rotation @ pose.translation[..., None])[..., 0]
        lever = np.zeros((*arm.shape[:-1], 6, 6))
        lever[..., range(6), range(6)] = 1.0
        lever[..., :3, 3:] = -_cross(arm)
        result = result + lever @ _square(own_covariance, "own_covariance") @ np.swapaxes(lever, -1, -2)
    return result.reshape(*result.shape[:-2], 36) if given.shape[-2:] != (6, 6) else result


def _square(values: ArrayLike, what: str) -> Array:
    array = np.asarray(values, dtype=np.float64)
    if array.shape[-2:] == (6, 6):
        return array
    if array.ndim and array.shape[-1] == 36:
        return array.reshape(*array.shape[:-1], 6, 6)
    raise ValueError(f"{what} must have the shape (..., 6, 6) or (..., 36), not {array.shape}")


def _cross(vectors: Array) -> Array:
    """Matrices whose product with u is the cross product of the vector and u."""
    matrix = np.zeros((*vectors.shape, 3))
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    matrix[..., 0, 1], matrix[..., 0, 2] = -z, y
    matrix[..., 1, 0], matrix[..., 1, 2] = z, -x
    matrix[..., 2, 0], matrix[..., 2, 1] = -y, x
    return matrix
