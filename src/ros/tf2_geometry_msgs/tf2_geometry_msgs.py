"""Transformation of geometry messages."""

from collections.abc import Iterable
from typing import Any, Optional, Tuple  # noqa: F401, UP035 - leaked upstream

import numpy as np
from numpy.typing import NDArray

import tf2_ros
from coframe import quaternion as quaternions
from geometry_msgs.msg import (
    Point,  # noqa: F401 - leaked upstream
    Point32,
    PointStamped,
    PolygonStamped,
    Pose,
    PoseArray,
    PoseStamped,
    PoseWithCovarianceStamped,
    QuaternionStamped,
    TransformStamped,
    Vector3Stamped,
)

Array = NDArray[np.float64]


def to_msg_msg(msg: Any) -> Any:
    """Return the message itself, which needs no conversion."""
    return msg


def from_msg_msg(msg: Any) -> Any:
    """Return the message itself, which needs no conversion."""
    return msg


def transform_covariance(cov_in: Any, transform: Any) -> Array:
    """Rotate the covariance of a pose.

    Args:
        cov_in: 6x6 covariance of (x, y, z, rotation about x, about y, about z) as 36 numbers in row-major order.
        transform: A `Transform` or `TransformStamped`. Only its rotation is used.

    Returns:
        The rotated covariance as 36 numbers in the same order. Each 3x3 block C becomes R C R^T.
    """
    rotation = _rotation(getattr(transform, "transform", transform))
    blocks = np.asarray(cov_in, dtype=np.float64).reshape(2, 3, 2, 3)
    return np.asarray(np.einsum("ij,ajbk,lk->aibl", rotation, blocks, rotation).reshape(36))


def do_transform_point(point: PointStamped, transform: TransformStamped) -> PointStamped:
    """Transform a point."""
    result = PointStamped(header=transform.header)
    result.point.x, result.point.y, result.point.z = _apply(transform, _xyz(point.point))
    return result


def do_transform_vector3(vector3: Vector3Stamped, transform: TransformStamped) -> Vector3Stamped:
    """Rotate a vector. The translation of the transform is ignored."""
    result = Vector3Stamped(header=transform.header)
    rotated = _rotation(transform.transform) @ _xyz(vector3.vector)
    result.vector.x, result.vector.y, result.vector.z = rotated.tolist()
    return result


def do_transform_pose(pose: Pose, transform: TransformStamped) -> Pose:
    """Transform a pose."""
    quaternion = pose.orientation
    affine = _transform_to_affine(transform) @ _build_affine(
        rotation=[quaternion.w, quaternion.x, quaternion.y, quaternion.z], translation=_xyz(pose.position)
    )
    position, orientation = _decompose_affine(affine)
    result = Pose()
    result.position.x, result.position.y, result.position.z = position.tolist()
    target = result.orientation
    target.w, target.x, target.y, target.z = orientation.tolist()
    return result


def do_transform_pose_stamped(pose: PoseStamped, transform: TransformStamped) -> PoseStamped:
    """Transform a stamped pose."""
    return PoseStamped(header=transform.header, pose=do_transform_pose(pose.pose, transform))


def do_transform_pose_with_covariance_stamped(
    pose: PoseWithCovarianceStamped, transform: TransformStamped
) -> PoseWithCovarianceStamped:
    """Transform a pose and its covariance."""
    result = PoseWithCovarianceStamped(header=transform.header)
    result.pose.pose = do_transform_pose(pose.pose.pose, transform)
    result.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return result


def do_transform_polygon_stamped(polygon: PolygonStamped, transform: TransformStamped) -> PolygonStamped:
    """Transform a polygon."""
    result = PolygonStamped(header=transform.header)
    points = []
    for corner in polygon.polygon.points:
        x, y, z = _apply(transform, _xyz(corner))
        points.append(Point32(x=x, y=y, z=z))
    result.polygon.points = points
    return result


def do_transform_quaternion_stamped(quaternion: QuaternionStamped, transform: TransformStamped) -> QuaternionStamped:
    """Transform an orientation, as in C++. The result is normalized with w >= 0."""
    result = QuaternionStamped(header=transform.header)
    target = result.quaternion
    target.x, target.y, target.z, target.w = _rotate_orientations([quaternion.quaternion], transform)[0]
    return result


def do_transform_pose_array(poses: PoseArray, transform: TransformStamped) -> PoseArray:
    """Transform an array of poses."""
    positions = np.array([_xyz(pose.position) for pose in poses.poses]).reshape(-1, 3)
    transformed = positions @ _rotation(transform.transform).T + _xyz(transform.transform.translation)
    rotated = _rotate_orientations([pose.orientation for pose in poses.poses], transform)
    result = PoseArray(header=transform.header)
    result.poses = [Pose() for _ in poses.poses]
    for pose, position, orientation in zip(result.poses, transformed.tolist(), rotated, strict=True):
        pose.position.x, pose.position.y, pose.position.z = position
        pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w = orientation
    return result


def _rotate_orientations(orientations: list[Any], transform: TransformStamped) -> list[list[float]]:
    """Return the rotated quaternions (x, y, z, w). Inputs are normalized, and a zero quaternion is the identity."""
    values = [[q.x, q.y, q.z, q.w] for q in (transform.transform.rotation, *orientations)]
    unit = np.array(values, dtype=np.float64)
    squared = np.einsum("ij,ij->i", unit, unit)
    unit[squared < np.finfo(np.float64).eps] = (0.0, 0.0, 0.0, 1.0)
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    rotated = quaternions.multiply(unit[0], unit[1:])
    rows: list[list[float]] = np.where(rotated[:, 3:] < 0.0, -rotated, rotated).tolist()
    return rows


def _xyz(vector: Any) -> Array:
    return np.array([vector.x, vector.y, vector.z], dtype=np.float64)


def _rotation(transform: Any) -> Array:
    q = transform.rotation
    return _get_mat_from_quat(np.array([q.w, q.x, q.y, q.z], dtype=np.float64))


def _apply(transform: TransformStamped, point: Array) -> list[float]:
    transformed = _rotation(transform.transform) @ point + _xyz(transform.transform.translation)
    return [float(value) for value in transformed]


def _build_affine(rotation: Iterable[float] | None = None, translation: Iterable[float] | None = None) -> Array:
    """Return the 4x4 matrix of a quaternion (w, x, y, z) and a translation, which are both optional."""
    affine = np.eye(4)
    if rotation is not None:
        affine[:3, :3] = _get_mat_from_quat(np.asarray(rotation, dtype=np.float64))
    if translation is not None:
        affine[:3, 3] = np.asarray(translation, dtype=np.float64)
    return affine


def _transform_to_affine(transform: TransformStamped) -> Array:
    """Return the 4x4 matrix of a `TransformStamped`."""
    affine = np.eye(4)
    affine[:3, :3] = _rotation(transform.transform)
    affine[:3, 3] = _xyz(transform.transform.translation)
    return affine


def _get_mat_from_quat(quaternion: Array) -> Array:
    """Return the 3x3 rotation matrix of a quaternion (w, x, y, z), which is normalized. Zero becomes the identity."""
    squared = float(quaternion @ quaternion)
    if squared < np.finfo(np.float64).eps:
        return np.eye(3)
    w, x, y, z = quaternion.tolist()
    s = 2.0 / squared
    return np.array(
        [
            [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
            [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
            [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
        ]
    )


def _get_quat_from_mat(rot_mat: Array) -> Array:
    """Return the quaternion (w, x, y, z) with w >= 0 that is closest to a 3x3 matrix.

    It is the eigenvector of the largest eigenvalue of Bar-Itzhack's matrix, even if the matrix is not exactly a
    rotation.
    """
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = np.asarray(rot_mat, dtype=np.float64)[:3, :3].tolist()
    lower = np.array(
        [
            [xx + yy + zz, 0.0, 0.0, 0.0],
            [zy - yz, xx - yy - zz, 0.0, 0.0],
            [xz - zx, yx + xy, yy - xx - zz, 0.0],
            [yx - xy, zx + xz, zy + yz, zz - xx - yy],
        ]
    )
    quaternion = np.linalg.eigh(lower, UPLO="L").eigenvectors[:, -1]
    return np.asarray(-quaternion if quaternion[0] < 0.0 else quaternion)


def _decompose_affine(affine: Array) -> tuple[Array, Array]:
    """Return the translation and the quaternion (w, x, y, z) of a 4x4 matrix."""
    return affine[:3, 3], _get_quat_from_mat(affine[:3, :3])


def _register() -> None:
    transforms = tf2_ros.TransformRegistration()
    transforms.add(PointStamped, do_transform_point)
    transforms.add(Vector3Stamped, do_transform_vector3)
    transforms.add(PoseStamped, do_transform_pose_stamped)
    transforms.add(PoseWithCovarianceStamped, do_transform_pose_with_covariance_stamped)
    transforms.add(PolygonStamped, do_transform_polygon_stamped)
    transforms.add(QuaternionStamped, do_transform_quaternion_stamped)
    transforms.add(PoseArray, do_transform_pose_array)
    conversions = tf2_ros.ConvertRegistration()
    for stamped in (Vector3Stamped, PoseStamped, PointStamped):
        conversions.add_to_msg(stamped, to_msg_msg)
        conversions.add_from_msg(stamped, from_msg_msg)


_register()
