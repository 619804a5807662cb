# SPDX-License-Identifier: Apache-2.0
"""Point clouds as structured arrays.

There are two forks of this package for ROS 2. In the older one `numpify` returns a structured array with the fields of
the cloud, in the newer one a dictionary with the positions under "xyz". Here it is a structured array that has "xyz" as
well. `msgify` takes both kinds.
"""

import sys
from array import array
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.lib.recfunctions import structured_to_unstructured
from numpy.typing import DTypeLike, NDArray

from builtin_interfaces.msg import Time
from ros2_numpy.registry import converts_from_numpy, converts_to_numpy
from sensor_msgs.msg import PointCloud2, PointField

__all__ = [
    "PointArray",
    "array_to_point_cloud2",
    "array_to_pointcloud2",
    "dict_to_point_cloud2",
    "dtype_to_fields",
    "fields_to_dtype",
    "get_xyz_points",
    "merge_rgb_fields",
    "point_cloud2_to_array",
    "pointcloud2_to_array",
    "pointcloud2_to_xyz_array",
    "split_rgb_field",
]

Array = NDArray[Any]

_TYPES = {
    PointField.INT8: "i1",
    PointField.UINT8: "u1",
    PointField.INT16: "i2",
    PointField.UINT16: "u2",
    PointField.INT32: "i4",
    PointField.UINT32: "u4",
    PointField.FLOAT32: "f4",
    PointField.FLOAT64: "f8",
    # The constants INT64, UINT64 and BOOL, which PointField has from Lyrical on.
    9: "i8",
    10: "u8",
    11: "?",
}
# Other nodes of the same distribution must know the types of clouds that are published.
_NUMBERS = {
    np.dtype(name): number
    for number, name in _TYPES.items()
    if number <= PointField.FLOAT64 or hasattr(PointField, "INT64")
}
_XYZ = ["x", "y", "z"]


class PointArray(np.ndarray[Any, Any]):
    """A structured array of points, in which "xyz" are the positions, shape (..., 3)."""

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str) and key == "xyz" and key not in (self.dtype.names or ()):
            return structured_to_unstructured(np.asarray(self)[_XYZ])
        return super().__getitem__(key)


@converts_to_numpy(PointField, plural=True)
def fields_to_dtype(fields: Iterable[PointField], point_step: int | None = None) -> np.dtype[Any]:
    """Return the dtype of points.

    Args:
        fields: Fields of a point. Those with a count above 1 become subarrays.
        point_step: Size of a point in bytes. None: points end with their last field.

    Raises:
        ValueError: A field has an unknown type, has the name of another one, or ends after the point.
    """
    fields = list(fields)
    unknown = [field for field in fields if field.datatype not in _TYPES]
    if unknown:
        raise ValueError(f"The field {unknown[0].name!r} of a point cloud has the unknown type {unknown[0].datatype}.")
    description: dict[str, Any] = {
        "names": [field.name for field in fields],
        "formats": [(_TYPES[field.datatype], (field.count,) if field.count > 1 else ()) for field in fields],
        "offsets": [field.offset for field in fields],
    }
    if point_step is not None:
        description["itemsize"] = point_step
    return np.dtype(description)  # type: ignore[call-overload, no-any-return]


@converts_from_numpy(PointField, plural=True)
def dtype_to_fields(dtype: np.dtype[Any]) -> list[PointField]:
    """Return the fields of points.

    Raises:
        TypeError: Clouds cannot have values of such a type.
    """
    fields = []
    for name in dtype.names or ():
        element, offset = dtype.fields[name][:2]  # type: ignore[index]
        if element.base.newbyteorder("=") not in _NUMBERS:
            raise TypeError(f"A point cloud cannot have the field {name!r} of type {element.base}.")
        count = int(np.prod(element.shape, dtype=int))
        number = _NUMBERS[element.base.newbyteorder("=")]
        fields.append(PointField(name=name, offset=offset, datatype=number, count=count))
    return fields


def pointcloud2_to_array(cloud_msg: PointCloud2, squeeze: bool = True) -> PointArray:
    """Return the points of a cloud, a view of the message.

    Args:
        cloud_msg: The cloud to convert.
        squeeze: Whether a cloud of one row has the shape (width,) instead of (1, width).

    Raises:
        ValueError: The data does not have the size of the cloud, or the fields are not valid.
    """
    dtype = fields_to_dtype(cloud_msg.fields, cloud_msg.point_step)
    dtype = dtype.newbyteorder(">" if cloud_msg.is_bigendian else "<")
    row_step = cloud_msg.row_step or cloud_msg.width * cloud_msg.point_step
    shape, strides = (cloud_msg.height, cloud_msg.width), (row_step, cloud_msg.point_step)
    points = PointArray(shape, dtype, buffer=cloud_msg.data, strides=strides)
    return points[0] if squeeze and cloud_msg.height == 1 else points  # type: ignore[no-any-return]


@converts_to_numpy(PointCloud2)
def point_cloud2_to_array(msg: PointCloud2, squeeze: bool = True) -> PointArray:
    """Return the points of a cloud. See `pointcloud2_to_array`."""
    return pointcloud2_to_array(msg, squeeze)


@converts_from_numpy(PointCloud2)
def array_to_point_cloud2(
    np_array: Array | Mapping[str, Array], frame_id: str | None = None, stamp: Time | None = None
) -> PointCloud2:
    """Return a cloud from a structured array, or from a dictionary as for `dict_to_point_cloud2`.

    Args:
        np_array: The points.
        frame_id: Frame of the cloud.
        stamp: Stamp of the cloud.

    Raises:
        TypeError: The array is not structured.
        ValueError: The dictionary has no "xyz".
    """
    if isinstance(np_array, Mapping):
        cloud = dict_to_point_cloud2(np_array, "base_link" if frame_id is None else frame_id)
        if stamp is not None:
            cloud.header.stamp = stamp
        return cloud
    return array_to_pointcloud2(np_array, stamp, frame_id)


def array_to_pointcloud2(cloud_arr: Array, stamp: Time | None = None, frame_id: str | None = None) -> PointCloud2:
    """Return a cloud from a structured array of shape (width,) or (height, width).

    Raises:
        TypeError: The array is not structured.
    """
    if cloud_arr.dtype.names is None:
        raise TypeError(
            f"A point cloud needs a structured array with fields such as x, y and z, not one of {cloud_arr.dtype}."
        )
    points = np.ascontiguousarray(np.atleast_2d(np.asarray(cloud_arr)))
    big = {field[0].base.byteorder for field in points.dtype.fields.values()} & {">"}  # type: ignore[union-attr]
    if big:
        points = points.astype(points.dtype.newbyteorder("<"))
    cloud = PointCloud2()
    if stamp is not None:
        cloud.header.stamp = stamp
    if frame_id is not None:
        cloud.header.frame_id = frame_id
    cloud.height, cloud.width = points.shape
    cloud.fields = dtype_to_fields(points.dtype)
    cloud.is_bigendian = sys.byteorder == "big" and not big
    cloud.point_step = points.dtype.itemsize
    cloud.row_step = cloud.point_step * cloud.width
    numbers = [points[name] for name in points.dtype.names or () if points.dtype[name].base.kind == "f"]
    cloud.is_dense = all(bool(np.isfinite(values).all()) for values in numbers)
    cloud.data = array("B", points.tobytes())
    return cloud


def dict_to_point_cloud2(point_cloud_dict: Mapping[str, Array], frame_id: str = "base_link") -> PointCloud2:
    """Return a cloud from a dictionary.

    Args:
        point_cloud_dict: The positions "xyz", shape (N, 3), and optionally the colors "rgb", uint8, shape (N, 3), and
            other fields, shape (N,) or (N, 1), such as "intensity". Floating-point numbers are stored as float32.
        frame_id: Frame of the cloud.

    Raises:
        ValueError: There is no "xyz", or an array does not have as many rows.
    """
    if "xyz" not in point_cloud_dict:
        raise ValueError(
            "The input dictionary must have an 'xyz' field. Something like {'xyz': np.array([[1, 2, 3], [4, 5, 6]])}"
        )
    xyz = np.asarray(point_cloud_dict["xyz"])
    columns: dict[str, Array] = dict(zip(_XYZ, xyz.T.astype(np.float32), strict=True))
    for name, values in point_cloud_dict.items():
        if name == "rgb" and np.ndim(values) == 2 and np.shape(values)[1] >= 3:
            columns[name] = _pack_colors(*np.asarray(values).T[:3])
        elif name != "xyz":
            column = np.asarray(values).reshape(len(values), -1)[:, 0]
            columns[name] = column.astype(np.float32) if column.dtype.kind == "f" else column
    types: list[tuple[str, DTypeLike]] = [(name, column.dtype) for name, column in columns.items()]
    points = np.empty(len(xyz), types)
    for name, column in columns.items():
        points[name] = column
    return array_to_pointcloud2(points, frame_id=frame_id)


def get_xyz_points(cloud_array: Array, remove_nans: bool = True, dtype: DTypeLike = np.float64) -> Array:
    """Return the positions of points, shape (N, 3).

    Args:
        cloud_array: Structured array with the fields x, y and z.
        remove_nans: Whether to skip points with a value that is not finite.
        dtype: Type of the result.
    """
    xyz: Array = structured_to_unstructured(np.asarray(cloud_array)[_XYZ])
    if remove_nans:
        finite = np.isfinite(xyz[..., 0]) & np.isfinite(xyz[..., 1]) & np.isfinite(xyz[..., 2])
        xyz = xyz.reshape(-1, 3) if finite.all() else xyz[finite]
    return xyz.astype(dtype)


def pointcloud2_to_xyz_array(cloud_msg: PointCloud2, remove_nans: bool = True) -> Array:
    """Return the positions of the points of a cloud, shape (N, 3), float64. See `get_xyz_points`."""
    return get_xyz_points(pointcloud2_to_array(cloud_msg), remove_nans=remove_nans)


def split_rgb_field(cloud_arr: Array) -> Array:
    """Return points whose field `rgb`, which has the colors in the bytes of a number, is split into r, g and b."""
    points = np.asarray(cloud_arr)
    packed = np.ascontiguousarray(points["rgb"]).view(np.uint32)
    kept = [(name, points.dtype[name]) for name in points.dtype.names or () if name != "rgb"]
    result = np.empty(points.shape, [*kept, ("r", np.uint8), ("g", np.uint8), ("b", np.uint8)])
    for name, _ in kept:
        result[name] = points[name]
    for name, shift in (("r", 16), ("g", 8), ("b", 0)):
        result[name] = (packed >> shift) & 255
    return result


def merge_rgb_fields(cloud_arr: Array) -> Array:
    """Return points whose fields r, g and b are combined into the float32 field `rgb`."""
    points = np.asarray(cloud_arr)
    kept = [(name, points.dtype[name]) for name in points.dtype.names or () if name not in {"r", "g", "b"}]
    result = np.empty(points.shape, [*kept, ("rgb", np.float32)])
    for name, _ in kept:
        result[name] = points[name]
    result["rgb"] = _pack_colors(points["r"], points["g"], points["b"]).view(np.float32)
    return result


def _pack_colors(red: Array, green: Array, blue: Array) -> NDArray[np.uint32]:
    r, g, b = (np.asarray(color, np.uint32) for color in (red, green, blue))
    return np.asarray((r << np.uint32(16)) | (g << np.uint32(8)) | b, np.uint32)
