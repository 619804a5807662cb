# SPDX-License-Identifier: Apache-2.0
"""Vectors, quaternions (x, y, z, w) and poses as arrays of float64."""

import numpy as np
from numpy.typing import NDArray

from geometry_msgs.msg import Point, Pose, Quaternion, Transform, Vector3
from ros2_numpy.registry import converts_from_numpy, converts_to_numpy
from tf_transformations import quaternion_from_matrix, quaternion_matrix

__all__ = [
    "numpy_to_point",
    "numpy_to_pose",
    "numpy_to_quat",
    "numpy_to_transform",
    "numpy_to_vector3",
    "point_to_numpy",
    "pose_to_numpy",
    "quat_to_numpy",
    "transform_to_numpy",
    "vector3_to_numpy",
]

Array = NDArray[np.float64]


@converts_to_numpy(Vector3)
def vector3_to_numpy(msg: Vector3, hom: bool = False) -> Array:
    """Return a vector, shape (3,), or with `hom` homogeneous, shape (4,) with a last value of 0."""
    return np.array([msg.x, msg.y, msg.z, 0.0][: 4 if hom else 3])


@converts_from_numpy(Vector3)
def numpy_to_vector3(arr: Array) -> Vector3:
    """Return a vector from an array of shape (3,), or (4,) with a last value of 0."""
    if arr.shape[-1] == 4:
        assert np.all(arr[..., -1] == 0)
        arr = arr[..., :-1]
    x, y, z = map(float, arr)
    return Vector3(x=x, y=y, z=z)


@converts_to_numpy(Point)
def point_to_numpy(msg: Point, hom: bool = False) -> Array:
    """Return a point, shape (3,), or with `hom` homogeneous, shape (4,) with a last value of 1."""
    return np.array([msg.x, msg.y, msg.z, 1.0][: 4 if hom else 3])


@converts_from_numpy(Point)
def numpy_to_point(arr: Array) -> Point:
    """Return a point from an array of shape (3,), or (4,) if it is homogeneous."""
    if arr.shape[-1] == 4:
        arr = arr[..., :-1] / arr[..., -1]
    x, y, z = map(float, arr)
    return Point(x=x, y=y, z=z)


@converts_to_numpy(Quaternion)
def quat_to_numpy(msg: Quaternion) -> Array:
    """Return a quaternion (x, y, z, w)."""
    return np.array([msg.x, msg.y, msg.z, msg.w])


@converts_from_numpy(Quaternion)
def numpy_to_quat(arr: Array) -> Quaternion:
    """Return a quaternion from an array (x, y, z, w)."""
    assert arr.shape[-1] == 4
    x, y, z, w = map(float, arr)
    return Quaternion(x=x, y=y, z=z, w=w)


@converts_to_numpy(Transform)
def transform_to_numpy(msg: Transform) -> Array:
    """Return a transform as a homogeneous matrix, shape (4, 4)."""
    return _matrix(msg.translation, msg.rotation)


@converts_from_numpy(Transform)
def numpy_to_transform(arr: Array) -> Transform:
    """Return a transform from a homogeneous matrix, shape (4, 4)."""
    assert arr.shape == (4, 4)
    return Transform(translation=numpy_to_vector3(arr[:3, 3]), rotation=numpy_to_quat(quaternion_from_matrix(arr)))


@converts_to_numpy(Pose)
def pose_to_numpy(msg: Pose) -> Array:
    """Return a pose as a homogeneous matrix, shape (4, 4)."""
    return _matrix(msg.position, msg.orientation)


@converts_from_numpy(Pose)
def numpy_to_pose(arr: Array) -> Pose:
    """Return a pose from a homogeneous matrix, shape (4, 4)."""
    assert arr.shape == (4, 4)
    return Pose(position=numpy_to_point(arr[:3, 3]), orientation=numpy_to_quat(quaternion_from_matrix(arr)))


def _matrix(position: Point | Vector3, rotation: Quaternion) -> Array:
    matrix = quaternion_matrix(quat_to_numpy(rotation))
    matrix[:3, 3] = position.x, position.y, position.z
    return matrix
