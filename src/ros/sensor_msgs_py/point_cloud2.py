# SPDX-License-Identifier: Apache-2.0
"""Conversion between `sensor_msgs/PointCloud2` and NumPy arrays."""

import sys
from array import array
from collections import namedtuple
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.lib.recfunctions import structured_to_unstructured, unstructured_to_structured
from numpy.typing import NDArray

from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

_DATATYPES: dict[int, np.dtype[Any]] = {
    PointField.INT8: np.dtype(np.int8),
    PointField.UINT8: np.dtype(np.uint8),
    PointField.INT16: np.dtype(np.int16),
    PointField.UINT16: np.dtype(np.uint16),
    PointField.INT32: np.dtype(np.int32),
    PointField.UINT32: np.dtype(np.uint32),
    PointField.FLOAT32: np.dtype(np.float32),
    PointField.FLOAT64: np.dtype(np.float64),
    # The constants INT64, UINT64 and BOOL, which PointField has from Lyrical on.
    9: np.dtype(np.int64),
    10: np.dtype(np.uint64),
    11: np.dtype(np.bool_),
}

DUMMY_FIELD_PREFIX = "unnamed_field"
MAX_ELEMENTS = 10_000  # of a point: a message may say that it has billions


def read_points(
    cloud: PointCloud2,
    field_names: list[str] | tuple[str, ...] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | NDArray[Any] | None = None,
    reshape_organized_cloud: bool = False,
) -> NDArray[Any]:
    """Return the points of a cloud as a structured array.

    Args:
        cloud: Cloud to read.
        field_names: Fields to read. None for all fields.
        skip_nans: Whether to skip points with a NaN in one of these fields.
        uvs: Indices of the points to read. None for all points.
        reshape_organized_cloud: Whether to return an organized cloud with the shape (width, height), as upstream.

    Returns:
        A structured array with shape (N,) and one name per field, which is a view of the data of the cloud if possible.
    """
    assert isinstance(cloud, PointCloud2), "Cloud is not a sensor_msgs.msg.PointCloud2"
    points: NDArray[Any] = as_structured(cloud).reshape(-1)
    if field_names is not None:
        assert all(name in (points.dtype.names or ()) for name in field_names), (
            "Requests field is not in the fields of the PointCloud!"
        )
        points = points[list(field_names)]
    if cloud.is_bigendian != (sys.byteorder == "big"):
        points = points.astype(points.dtype.newbyteorder("="))
    if skip_nans and len(points):
        points = points[~_has_nan(points)]
    if uvs is not None:
        points = points[uvs if isinstance(uvs, np.ndarray) else np.fromiter(uvs, int)]
    if reshape_organized_cloud and cloud.height > 1:
        points = points.reshape(cloud.width, cloud.height)
    return points


def read_points_numpy(
    cloud: PointCloud2,
    field_names: list[str] | tuple[str, ...] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | NDArray[Any] | None = None,
    reshape_organized_cloud: bool = False,
) -> NDArray[Any]:
    """Return the points of a cloud as an unstructured array with shape (N, fields).

    All fields must have the same type. The arguments are the same as for `read_points`.
    """
    points = read_points(cloud, field_names, skip_nans, uvs, reshape_organized_cloud)
    types = {points.dtype[name] for name in points.dtype.names or ()}
    assert len(types) <= 1, "All fields need to have the same datatype. Use `read_points()` otherwise."
    return np.asarray(structured_to_unstructured(points))


def read_points_list(
    cloud: PointCloud2,
    field_names: list[str] | tuple[str, ...] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | NDArray[Any] | None = None,
) -> list[Any]:
    """Return the points of a cloud as named tuples, which is slow. The arguments are the same as for `read_points`."""
    assert isinstance(cloud, PointCloud2), "Cloud is not a sensor_msgs.msg.PointCloud2"
    points = read_points(cloud, field_names, skip_nans, uvs)
    point_type = namedtuple("Point", points.dtype.names or ())  # type: ignore[misc]  # noqa: PYI024 - names are data
    return [point_type._make(point) for point in points.tolist()]


def dtype_from_fields(fields: Iterable[PointField], point_step: int | None = None) -> np.dtype[Any]:
    """Return the structured dtype of a list of `PointField`.

    Args:
        fields: Fields of a point. A field with a count above 1 becomes several, named `<field>_0`, `<field>_1`, ...
        point_step: Size of a point in bytes, if there is padding after the last field.

    Raises:
        ValueError: A point has more than 10 000 elements, or a field is beyond `point_step`.
    """
    fields = list(fields)
    if sum(field.count for field in fields) > MAX_ELEMENTS:
        raise ValueError(f"A point has more than the maximum of {MAX_ELEMENTS} elements.")
    names: dict[str, None] = {}
    formats: list[np.dtype[Any]] = []
    offsets: list[int] = []
    for number, field in enumerate(fields):
        assert field.count > 0, "Can't process fields with count = 0."
        datatype = _DATATYPES[field.datatype]
        name = field.name or f"{DUMMY_FIELD_PREFIX}_{number}"
        for element in range(field.count):
            element_name = f"{name}_{element}" if field.count > 1 else name
            assert element_name not in names, "Duplicate field names are not allowed!"
            names[element_name] = None
            formats.append(datatype)
            offsets.append(field.offset + element * datatype.itemsize)
    description: Any = {"names": list(names), "formats": formats, "offsets": offsets}
    if point_step is not None:
        description["itemsize"] = point_step
    dtype: np.dtype[Any] = np.dtype(description)
    return dtype


def create_cloud(
    header: Header,
    fields: Iterable[PointField],
    points: Any,
    point_step: int | None = None,
) -> PointCloud2:
    """Create a cloud from points.

    Args:
        header: Header of the cloud.
        fields: Fields of a point.
        points: Structured array, unstructured array of shape (N, fields), or iterable of points. An array of points
            with shape (width, height) creates an organized cloud.
        point_step: Size of a point in bytes, if there should be padding after the last field.
    """
    fields = list(fields)
    structured = np.ascontiguousarray(_to_structured(fields, points, point_step))
    assert structured.ndim <= 2, (
        "Too many dimensions for organized cloud! Points can only be organized in max. two dimensional space"
    )
    width = structured.shape[0]
    height = structured.shape[1] if structured.ndim == 2 else 1
    cloud = PointCloud2(
        header=header,
        height=height,
        width=width,
        is_dense=False,
        is_bigendian=sys.byteorder != "little",
        fields=fields,
        point_step=structured.dtype.itemsize,
        row_step=structured.dtype.itemsize * width,
    )
    cloud.data = array("B", structured.tobytes())
    return cloud


def create_cloud_xyz32(header: Header, points: Any, point_step: int | None = None) -> PointCloud2:
    """Create a cloud with the float32 fields x, y and z. The arguments are the same as for `create_cloud`."""
    fields = [
        PointField(name=name, offset=4 * number, datatype=PointField.FLOAT32, count=1)
        for number, name in enumerate("xyz")
    ]
    return create_cloud(header, fields, points, point_step)


def as_structured(cloud: PointCloud2) -> NDArray[Any]:
    """Return a view of the cloud's data as a structured array of shape (height, width) in the cloud's byte order."""
    if cloud.height * cloud.width > len(cloud.data):  # with points of 0 bytes, there could be any number
        raise ValueError(f"The cloud has {cloud.height} x {cloud.width} points, but {len(cloud.data)} bytes of data.")
    dtype = dtype_from_fields(cloud.fields, cloud.point_step).newbyteorder(">" if cloud.is_bigendian else "<")
    row_step = cloud.row_step or cloud.point_step * cloud.width
    strides = (row_step, cloud.point_step)
    points: NDArray[Any] = np.ndarray((cloud.height, cloud.width), dtype, buffer=cloud.data, strides=strides)
    return points


def _has_nan(points: NDArray[Any]) -> NDArray[np.bool_]:
    found = np.zeros(len(points), dtype=np.bool_)
    for name in points.dtype.names or ():
        found |= np.isnan(points[name])
    return found


def _without_garbage(points: NDArray[Any]) -> NDArray[Any]:
    """Return the points with zeros as padding, where NumPy leaves what was in memory before."""
    clean: NDArray[Any] = np.zeros(points.shape, dtype=points.dtype)
    clean[:] = points
    return clean


def _to_structured(fields: list[PointField], points: Any, point_step: int | None) -> NDArray[Any]:
    dtype = dtype_from_fields(fields, point_step)
    if not isinstance(points, np.ndarray):
        return _without_garbage(np.array([tuple(point) for point in points], dtype=dtype))
    if points.dtype.names is None:
        assert all(fields[0].datatype == field.datatype for field in fields[1:]), (
            "All fields need to have the same datatype. Pass a structured NumPy array with multiple dtypes otherwise."
        )
        return _without_garbage(unstructured_to_structured(points, dtype=dtype))
    assert points.dtype == dtype, (
        "PointFields and structured NumPy array dtype do not match for all fields! "
        "Check their field order, names and types."
    )
    return points
