# SPDX-License-Identifier: Apache-2.0
"""Access the fields of points in messages and arrays, and the memory for results."""

from __future__ import annotations

import copy
from array import array
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    # Triples of field names or of column indices.
    Vectors: TypeAlias = Sequence[str] | Sequence[int] | Sequence[Sequence[str]] | Sequence[Sequence[int]]

__all__ = ["coordinates", "destination", "field_of", "grid_shape", "is_message", "message_with_float64"]

Triple: TypeAlias = "tuple[NDArray[Any], NDArray[Any], NDArray[Any]]"

_POSITION = ("x", "y", "z")
_FLOAT64 = 8  # PointField.FLOAT64
NORMALS = (("normal_x", "normal_y", "normal_z"), ("nx", "ny", "nz"))
# NumPy dtypes by PointField constant, for both byte orders.
_KINDS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8", 9: "i8", 10: "u8", 11: "b1"}
_DTYPES = {
    is_bigendian: {number: np.dtype(order + kind) for number, kind in _KINDS.items()}
    for is_bigendian, order in ((False, "<"), (True, ">"))
}


def is_message(points: Any) -> bool:
    """Return whether the points are a PointCloud2 message, whether of coframe, ROS or a bag reader.

    Raises:
        TypeError: The points are neither a message nor an array.
        ValueError: The array does not have three coordinates per point.
    """
    if hasattr(points, "point_step") and hasattr(points, "fields"):
        return True
    if not isinstance(points, np.ndarray):
        raise TypeError(f"points must be a PointCloud2 message or a numpy array, not {type(points).__name__}")
    if points.dtype.names is None and (points.ndim not in {2, 3} or points.shape[-1] < 3):
        raise ValueError(f"an array of points must have shape (N, 3) or (rows, columns, 3), not {points.shape}")
    if points.dtype.names is not None and points.ndim not in {1, 2}:
        raise ValueError(f"a structured array of points must have one or two axes, not {points.ndim}")
    return False


def grid_shape(points: Any) -> tuple[int, ...]:
    """Return the shape of the points: (N,), or (rows, columns) for an organized cloud.

    Raises:
        ValueError: A message has fewer bytes than points.
    """
    if is_message(points):
        rows, columns, available = points.height, points.width, len(_memory(points.data))
        if min(rows, columns) < 0 or rows * columns > available:
            raise ValueError(f"the cloud's data has {available} bytes, too few for {rows} rows of {columns} points")
        return rows, columns
    return points.shape if points.dtype.names is not None else points.shape[:-1]  # type: ignore[no-any-return]


def field_of(points: Any, name: str | int) -> NDArray[Any]:
    """Return a field of all points without a copy, by its name or as a column of a plain array.

    Raises:
        ValueError: The field does not exist, or is outside the data of the message.
    """
    if is_message(points):
        return _message_field(points, str(name))
    if points.dtype.names is None:
        if not isinstance(name, int) or not 0 <= name < points.shape[-1]:
            raise ValueError(f"an array of {points.shape[-1]} columns has no column {name!r}")
        return points[..., name]  # type: ignore[no-any-return]
    if name not in points.dtype.names:
        raise _missing_field_error(name, list(points.dtype.names))
    field: NDArray[Any] = points[name]
    return _require_single(field, name, field.size // max(points.size, 1))


def coordinates(points: Any, vectors: Vectors, normals: Sequence[Sequence[str]] = NORMALS) -> list[Triple]:
    """Return the fields that a transform changes: the position, then the vectors, which are only rotated.

    Args:
        points: A message or an array.
        vectors: Vectors in addition to normals: three names or column indices, or a sequence of such triples.
        normals: Triples of field names that are vectors if all three exist.

    Raises:
        ValueError: A field is missing, or is not float32 or float64.
    """
    message = is_message(points)
    is_plain_array = not message and points.dtype.names is None
    names = () if is_plain_array else [f.name for f in points.fields] if message else points.dtype.names
    triples: list[Sequence[str | int]] = [(0, 1, 2) if is_plain_array else _POSITION]
    triples += [triple for triple in normals if set(triple) <= set(names)]
    triples += [triple for triple in _triples(vectors) if tuple(triple) not in {tuple(other) for other in triples}]
    return [_read_triple(points, triple) for triple in triples]


def destination(points: Any, out: Any, *, in_place: bool) -> Any:
    """Return the object to change: the points themselves, ``out`` with a copy of the points, or a new copy.

    A message has a new header, whose stamp may still be the object in ``points``.

    Raises:
        TypeError: The type of ``out`` differs from that of the points.
        ValueError: Both ``out`` and ``in_place`` are given, or the array has another shape or is read-only.
    """
    if in_place and out is not None and out is not points:
        raise ValueError("in_place=True and out=... are mutually exclusive")
    in_place = in_place or out is points
    if not is_message(points):
        return _array_destination(points, out, in_place=in_place)
    if in_place:
        if _memory(points.data).readonly:
            raise ValueError("the data of the message is read-only. Omit in_place and out to get a new message.")
        return points
    result = copy.copy(points) if out is None else out
    if out is not None:
        for name in ("height", "width", "fields", "is_bigendian", "point_step", "row_step", "is_dense"):
            setattr(out, name, getattr(points, name))
    result.header = copy.copy(points.header)
    if out is None or not _copy_into(out.data, points.data):
        result.data = _copy_data(points.data)
    return result


def message_with_float64(cloud: Any) -> Any:
    """Return a copy of a message whose x, y and z are float64, with packed fields in the same order.

    Raises:
        ValueError: A field has an unknown type or is outside the data.
    """
    types = _DTYPES[bool(cloud.is_bigendian)]
    wide = types[_FLOAT64]
    result = copy.copy(cloud)
    result.header, result.fields, columns = copy.copy(cloud.header), [], []
    offset = 0
    for field in cloud.fields:
        is_position = field.name in _POSITION
        dtype = wide if is_position else types.get(field.datatype)
        if dtype is None:
            raise ValueError(f"the field {field.name!r} has the unknown datatype {field.datatype}")
        size = dtype.itemsize * max(field.count, 1)
        columns.append((field, is_position, offset, size))
        new_field = copy.copy(field)
        new_field.offset, new_field.datatype = offset, _FLOAT64 if is_position else field.datatype
        result.fields.append(new_field)
        offset += size
    rows, width = grid_shape(cloud)
    packed = np.zeros((rows, width, offset), np.uint8)
    for field, is_position, start, size in columns if packed.size else ():
        part = packed[:, :, start : start + size]
        if is_position:
            part[...] = _message_field(cloud, field.name).astype(wide)[..., None].view(np.uint8)
        else:
            part[...] = _field_bytes(cloud, field.name, field.offset, size)
    result.point_step, result.row_step = offset, offset * width
    result.data = array("B", packed.tobytes())
    return result


def _field_bytes(cloud: Any, name: str, offset: int, size: int) -> NDArray[np.uint8]:
    """Return the bytes of a field with any number of elements: (rows, columns, size)."""
    rows, columns, step = cloud.height, cloud.width, cloud.point_step
    row_step = cloud.row_step if rows > 1 and cloud.row_step else columns * step
    memory = _memory(cloud.data)
    _check_layout(name, offset, size, rows, columns, step, row_step, len(memory))
    field: NDArray[np.uint8] = np.ndarray((rows, columns, size), np.uint8, memory, offset, strides=(row_step, step, 1))
    return field


def _array_destination(points: NDArray[Any], out: Any, *, in_place: bool) -> NDArray[Any]:
    if out is None and not in_place:
        copied: NDArray[Any] = points.copy()
        return copied
    result = points if in_place else out
    if not isinstance(result, np.ndarray):
        raise TypeError(f"out must be a NumPy array like the points, not {type(out).__name__}")
    if not result.flags.writeable:
        raise ValueError("the array for the result is read-only. Omit in_place and out to get a new array.")
    if not in_place:
        if out.shape != points.shape:
            raise ValueError(f"out must have the shape of the points, {points.shape}, not {out.shape}")
        np.copyto(out, points, casting="same_kind")
    return result


def _memory(data: Any) -> memoryview:
    """Return the bytes of a message, or a copy if they are not contiguous."""
    try:
        return memoryview(data).cast("B")
    except TypeError:
        return memoryview(bytes(data))


def _copy_data(data: Any) -> Any:
    if isinstance(data, array):
        return data[:]
    return data.copy() if isinstance(data, np.ndarray) else array("B", bytes(data))


def _copy_into(memory: Any, data: Any) -> bool:
    """Copy the data into the memory of a reused message, or False if the memory is not suitable."""
    if memory is data or _memory(memory).readonly or len(_memory(memory)) != len(_memory(data)):
        return False
    _memory(memory)[:] = _memory(data)
    return True


def _triples(vectors: Any) -> list[Sequence[str | int]]:
    if isinstance(vectors, str):
        raise TypeError(f"vectors must be three names or a sequence of such triples, not {vectors!r}")
    vectors = list(vectors)
    triples = [vectors] if vectors and isinstance(vectors[0], str | int) else vectors
    for triple in triples:
        if isinstance(triple, str) or len(triple) != 3:
            raise ValueError(f"a vector must have three fields, not {triple!r}")
    return triples


def _read_triple(points: Any, names: Sequence[str | int]) -> Triple:
    x, y, z = (_read_number_field(points, name) for name in names)
    return x, y, z


def _read_number_field(points: Any, name: str | int) -> NDArray[Any]:
    field = field_of(points, name)
    if field.dtype.kind != "f" or field.dtype.itemsize not in {4, 8}:
        raise ValueError(f"the field {name!r} must be float32 or float64, not {field.dtype}")
    return field


def _message_field(cloud: Any, name: str) -> NDArray[Any]:
    field = next((field for field in cloud.fields if field.name == name), None)
    if field is None:
        raise _missing_field_error(name, [field.name for field in cloud.fields])
    dtype = _DTYPES[bool(cloud.is_bigendian)].get(field.datatype)
    if dtype is None:
        raise ValueError(f"the field {name!r} has the unknown datatype {field.datatype}")
    rows, columns, step = cloud.height, cloud.width, cloud.point_step
    # Many publishers set a wrong row_step if there is only one row.
    row_step = cloud.row_step if rows > 1 and cloud.row_step else columns * step
    if rows * columns == 0:
        return np.empty((rows, columns), dtype)
    memory = _memory(cloud.data)
    _check_layout(name, field.offset, dtype.itemsize, rows, columns, step, row_step, len(memory))
    points: NDArray[Any] = np.ndarray((rows, columns), dtype, memory, field.offset, strides=(row_step, step))
    return _require_single(points, name, field.count)


def _check_layout(
    name: str, offset: int, size: int, rows: int, columns: int, step: int, row_step: int, available: int
) -> None:
    """Raise ValueError if a field is outside the data or points overlap."""
    if min(offset, rows, columns) < 0:
        raise ValueError("the offsets, height and width of a cloud must not be negative")
    if offset + size > step:
        raise ValueError(f"the field {name!r} ends at byte {offset + size} of a point, but point_step is {step}")
    if row_step < columns * step:
        raise ValueError(f"{columns} points of {step} bytes (width, point_step) do not fit a row_step of {row_step}")
    needed = (rows - 1) * row_step + (columns - 1) * step + offset + size
    if needed > available:
        raise ValueError(
            f"the cloud's data has {available} bytes, but {rows} rows of {columns} points (height, width) need {needed}"
        )


def _require_single(field: NDArray[Any], name: object, count: int) -> NDArray[Any]:
    if count > 1:
        raise ValueError(f"the field {name!r} must have one number per point, not {count}")
    return field


def _missing_field_error(name: object, names: list[str]) -> ValueError:
    return ValueError(f"the points have no field {name!r}. Their fields: {', '.join(map(repr, names)) or 'none'}.")
