"""Transformation of point clouds."""

import math
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tf2_ros
from coframe.sensors.clouds import move
from coframe.sensors.layout import destination
from geometry_msgs.msg import Transform, TransformStamped
from sensor_msgs.msg import PointCloud2

Array = NDArray[np.float64]

_NORMAL = ("normal_x", "normal_y", "normal_z")


def to_msg_msg(msg: PointCloud2) -> PointCloud2:
    """Return the message itself, which needs no conversion."""
    return msg


def from_msg_msg(msg: PointCloud2) -> PointCloud2:
    """Return the message itself, which needs no conversion."""
    return msg


def transform_points(point_cloud: NDArray[Any], transform: Transform) -> Array:
    """Rotate and translate points.

    Args:
        point_cloud: Points, shape (N, 3).
        transform: A `geometry_msgs/Transform`.

    Returns:
        The points in the other frame, shape (N, 3), float64.

    Raises:
        ValueError: The points have another shape.
    """
    points = np.array(point_cloud, dtype=np.float64, order="C")
    if points.shape[-1:] != (3,):
        raise ValueError(f"points must have the shape (N, 3), not {points.shape}.")
    move(points.reshape(-1, 3), _values(transform))
    return points


def do_transform_cloud(cloud: PointCloud2, transform: Transform | TransformStamped) -> PointCloud2:
    """Transform a point cloud.

    Normals in the fields normal_x, normal_y and normal_z are also rotated, as in C++ since Humble's 0.25.14. Other
    fields, the stamp and the layout of the cloud do not change. The argument is not modified.

    Args:
        cloud: A cloud with the fields x, y and z, float32 or float64.
        transform: Transform into the target frame. If it is stamped, the result has its frame_id.

    Raises:
        AssertionError: The cloud has no field x, y or z.
        ValueError: The sizes of the cloud do not match its data.
    """
    assert {field.name for field in cloud.fields}.issuperset("xyz"), (
        "Point cloud needs the fields x, y, and z for the transformation"
    )
    result: PointCloud2 = destination(cloud, None, in_place=False)
    if isinstance(transform, TransformStamped):
        result.header.frame_id = transform.header.frame_id
        transform = transform.transform
    move(result, _values(transform), normals=[_NORMAL])
    return result


def _values(transform: Transform) -> tuple[float, float, float, float, float, float, float]:
    """Return the pose values with a unit quaternion. A zero quaternion results in the identity, as elsewhere in tf2."""
    t, q = transform.translation, transform.rotation
    length = math.sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w)
    if length**2 < sys.float_info.epsilon:
        return t.x, t.y, t.z, 0.0, 0.0, 0.0, 1.0
    return t.x, t.y, t.z, q.x / length, q.y / length, q.z / length, q.w / length


def _register() -> None:
    tf2_ros.TransformRegistration().add(PointCloud2, do_transform_cloud)
    conversions = tf2_ros.ConvertRegistration()
    conversions.add_to_msg(PointCloud2, to_msg_msg)
    conversions.add_from_msg(PointCloud2, from_msg_msg)


_register()
