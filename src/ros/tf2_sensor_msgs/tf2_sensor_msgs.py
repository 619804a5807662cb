"""Point clouds seen from another frame."""

from array import array
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tf2_ros
from geometry_msgs.msg import Transform, TransformStamped
from sensor_msgs.msg import PointCloud2
from sensor_msgs_py.point_cloud2 import as_structured
from std_msgs.msg import Header
from tf2_geometry_msgs.tf2_geometry_msgs import _get_mat_from_quat

Array = NDArray[np.float64]

_POSITION = ("x", "y", "z")
_NORMAL = ("normal_x", "normal_y", "normal_z")


def to_msg_msg(msg: PointCloud2) -> PointCloud2:
    """The message itself: it needs no conversion."""
    return msg


def from_msg_msg(msg: PointCloud2) -> PointCloud2:
    """The message itself: it needs no conversion."""
    return msg


def transform_points(point_cloud: NDArray[Any], transform: Transform) -> Array:
    """Rotate and move points.

    Args:
        point_cloud: Points, shape (N, 3).
        transform: A `geometry_msgs/Transform`.

    Returns:
        The points in the other frame, shape (N, 3), float64.
    """
    q, t = transform.rotation, transform.translation
    rotation = _get_mat_from_quat(np.array([q.w, q.x, q.y, q.z]))
    points = np.asarray(point_cloud, dtype=np.float64)
    return np.asarray(points @ rotation.T + np.array([t.x, t.y, t.z]))


def do_transform_cloud(cloud: PointCloud2, transform: Transform | TransformStamped) -> PointCloud2:
    """A point cloud, seen from the transform's frame.

    Normals, the fields normal_x, normal_y and normal_z, are rotated along, as C++ does it since Humble's 0.25.14. Other
    fields, the cloud's stamp and its layout stay as they are; the argument is not touched.

    Args:
        cloud: A cloud with the fields x, y and z.
        transform: Its frame becomes the result's if it is stamped.

    Raises:
        AssertionError: The cloud lacks x, y or z.
    """
    header = Header(stamp=cloud.header.stamp, frame_id=cloud.header.frame_id)
    if isinstance(transform, TransformStamped):
        header.frame_id = transform.header.frame_id
        transform = transform.transform
    names = {field.name for field in cloud.fields}
    assert names.issuperset(_POSITION), "Point cloud needs the fields x, y, and z for the transformation"
    result = PointCloud2(
        header=header,
        height=cloud.height,
        width=cloud.width,
        fields=cloud.fields,
        is_bigendian=cloud.is_bigendian,
        point_step=cloud.point_step,
        row_step=cloud.row_step,
        is_dense=cloud.is_dense,
    )
    result.data = array("B", bytes(cloud.data))
    points = as_structured(result)
    _move(points, _POSITION, transform)
    if names.issuperset(_NORMAL):
        _move(points, _NORMAL, Transform(rotation=transform.rotation))
    return result


def _move(points: NDArray[Any], fields: tuple[str, str, str], transform: Transform) -> None:
    """Transforms three fields of structured points, in place."""
    moved = transform_points(np.stack([points[field].ravel() for field in fields], axis=1), transform)
    for column, field in enumerate(fields):
        points[field] = moved[:, column].reshape(points.shape)


def _register() -> None:
    tf2_ros.TransformRegistration().add(PointCloud2, do_transform_cloud)
    conversions = tf2_ros.ConvertRegistration()
    conversions.add_to_msg(PointCloud2, to_msg_msg)
    conversions.add_from_msg(PointCloud2, from_msg_msg)


_register()
