"""Points of a `sensor_msgs/PointCloud2` as numpy arrays, and clouds out of arrays."""

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
}

DUMMY_FIELD_PREFIX = "unnamed_field"


def read_points(
    cloud: PointCloud2,
    field_names: list[str] | tuple[str, ...] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | NDArray[Any] | None = None,
    reshape_organized_cloud: bool = False,
) -> NDArray[Any]:
    """The points of a cloud.

    Args:
        cloud: The cloud.
        field_names: Fields to read; all by default.
        skip_nans: Leave out points with a NaN in one of these fields.
        uvs: Indices of the points to read; all by default.
        reshape_organized_cloud: Return an organized cloud with the shape (width, height), as upstream does.

    Returns:
        A structured array, shape (N,), with one name per field. It looks at the cloud's own bytes where it can.
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
    """The points of a cloud as a plain array, shape (N, fields); the fields need to have one type.

    The arguments are those of `read_points`.
    """
    assert all(cloud.fields[0].datatype == field.datatype for field in cloud.fields[1:]), (
        "All fields need to have the same datatype. Use `read_points()` otherwise."
    )
    return structured_to_unstructured(read_points(cloud, field_names, skip_nans, uvs, reshape_organized_cloud))


def read_points_list(
    cloud: PointCloud2,
    field_names: list[str] | tuple[str, ...] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | NDArray[Any] | None = None,
) -> list[Any]:
    """The points of a cloud as named tuples; slow, and nice to read. The arguments are those of `read_points`."""
    assert isinstance(cloud, PointCloud2), "Cloud is not a sensor_msgs.msg.PointCloud2"
    points = read_points(cloud, field_names, skip_nans, uvs)
    point_type = namedtuple("Point", points.dtype.names or ())  # type: ignore[misc]  # noqa: PYI024 - names are data
    return [point_type._make(point) for point in points.tolist()]


def dtype_from_fields(fields: Iterable[PointField], point_step: int | None = None) -> np.dtype[Any]:
    """The structured dtype of a list of `PointField`.

    Args:
        fields: The fields. One with a count above 1 becomes several, named `<field>_0`, `<field>_1`, ...
        point_step: Bytes of one point, when there is padding after the last field.
    """
    names: list[str] = []
    formats: list[np.dtype[Any]] = []
    offsets: list[int] = []
    for number, field in enumerate(fields):
        assert field.count > 0, "Can't process fields with count = 0."
        datatype = _DATATYPES[field.datatype]
        name = field.name or f"{DUMMY_FIELD_PREFIX}_{number}"
        for element in range(field.count):
            element_name = f"{name}_{element}" if field.count > 1 else name
            assert element_name not in names, "Duplicate field names are not allowed!"
            names.append(element_name)
            formats.append(datatype)
            offsets.append(field.offset + element * datatype.itemsize)
    description: dict[str, Any] = {"names": names, "formats": formats, "offsets": offsets}
    if point_step is not None:
        description["itemsize"] = point_step
    return np.dtype(description)  # type: ignore[call-overload, no-any-return]


def create_cloud(
    header: Header,
    fields: Iterable[PointField],
    points: Any,
    point_step: int | None = None,
) -> PointCloud2:
    """A cloud of points.

    Args:
        header: Its header.
        fields: Its fields.
        points: A structured array, a plain array of shape (N, fields), or an iterable of points; an array of
            points of shape (width, height) makes an organized cloud.
        point_step: Bytes of one point, when there shall be padding after the last field.
    """
    fields = list(fields)
    structured = np.ascontiguousarray(_structured(fields, points, point_step))
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
    """A cloud of points with the float32 fields x, y and z; the arguments are those of `create_cloud`."""
    fields = [
        PointField(name=name, offset=4 * number, datatype=PointField.FLOAT32, count=1)
        for number, name in enumerate("xyz")
    ]
    return create_cloud(header, fields, points, point_step)


def as_structured(cloud: PointCloud2) -> NDArray[Any]:
    """The cloud's bytes as a structured array, shape (height, width), in the cloud's byte order; not a copy."""
    dtype = dtype_from_fields(cloud.fields, cloud.point_step).newbyteorder(">" if cloud.is_bigendian else "<")
    row_step = cloud.row_step or cloud.point_step * cloud.width
    shape = (cloud.height, cloud.width)
    return np.ndarray(shape, dtype, buffer=cloud.data, strides=(row_step, cloud.point_step))


def _has_nan(points: NDArray[Any]) -> NDArray[np.bool_]:
    found = np.zeros(len(points), dtype=np.bool_)
    for name in points.dtype.names or ():
        found |= np.isnan(points[name])
    return found


def _structured(fields: list[PointField], points: Any, point_step: int | None) -> NDArray[Any]:
    dtype = dtype_from_fields(fields, point_step)
    if not isinstance(points, np.ndarray):
        return np.array([tuple(point) for point in points], dtype=dtype)
    if points.dtype.names is None:
        assert all(fields[0].datatype == field.datatype for field in fields[1:]), (
            "All fields need to have the same datatype. Pass a structured NumPy array with multiple dtypes otherwise."
        )
        return np.asarray(unstructured_to_structured(points, dtype=dtype))
    assert points.dtype == dtype, (
        "PointFields and structured NumPy array dtype do not match for all fields! "
        "Check their field order, names and types."
    )
    return points
