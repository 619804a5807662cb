# SPDX-License-Identifier: Apache-2.0
"""Point cloud files: PLY, PCD, NumPy's npy and npz, a folder of these, or a new recording."""

from __future__ import annotations

import tempfile
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, Protocol

import numpy as np

from coframe import time
from coframe._files.complete_files import complete_or_absent
from coframe.bags._mcap_writer import McapWriter
from coframe.errors import RecordingError
from coframe.messages import find, serialize
from coframe.messages.definition_texts import definition_of
from coframe.sensors.point_times import DESKEWED_PREFIX
from coframe.sensors.rounding import largest_coordinate, warn_of_rounding
from coframe.sensors.thinning import thin_points
from coframe.type_names import POINT_CLOUD

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from coframe.bags._clouds import Cloud, Clouds

__all__ = ["CLOUD_FORMATS", "write_clouds"]

_FLOAT64_ADVICE = "float64=True keeps them, and so do .ply, .npz and .npy files."
CLOUD_FORMATS = ("ply", "pcd", "npz", "npy", "mcap")
_COLORS = ("red", "green", "blue")
_MAX_DIGITS = 20  # space in the header for the count, which is known only at the end
_NPY_PREAMBLE_BYTES = 12  # bytes before the text of NumPy's header


def write_clouds(
    clouds: Clouds,
    target: str | os.PathLike[str],
    *,
    format_: str | None = None,
    voxel: float | None = None,
    float64: bool = False,
    progress: Callable[[int], object] = lambda _count: None,
) -> int:
    """Stream the points of all messages to a file; memory use does not depend on the number of messages.

    The time field of deskewed points is renamed, so that no reader deskews them again: ``t`` becomes ``deskewed_t``.

    Args:
        clouds: The clouds to write; they are read one at a time.
        target: A file or a folder. A file that ends with ``.ply``, ``.pcd``, ``.npz`` or ``.npy`` contains all points
            as one cloud. A file that ends with ``.mcap`` is a new recording with one PointCloud2 per message. Any other
            name is a folder with one file per message, named by its stamp.
        format_: Format of the files in a folder: ``"ply"`` (default), ``"pcd"``, ``"npz"`` or ``"npy"``.
        voxel: Keep only the first point in each voxel with this edge length in meters. If one cloud is written, its
            points are kept in memory.
        float64: Also write the coordinates in PCD and MCAP files as float64, where float32 is usual. Without it, a
        :class:`coframe.CoframeWarning` is issued if float32 rounds them by more than a millimeter.
        progress: Called with the number of messages read so far.

    Returns:
        The number of points written.

    Raises:
        RecordingError: No message could be transformed, or a package is not installed.
        ValueError: The format is unknown, or the messages have different fields.
        OSError: The file cannot be written.
    """
    path = Path(target)
    suffix = path.suffix.lower().removeprefix(".")
    is_folder = suffix not in CLOUD_FORMATS or path.is_dir()
    kind = (format_ or "ply") if is_folder else suffix
    if is_folder and suffix and format_ is None and not path.is_dir():
        raise ValueError(
            f"No format named {suffix!r}. Known suffixes: {', '.join(CLOUD_FORMATS)}. A folder has no suffix."
        )
    if kind not in CLOUD_FORMATS or (is_folder and kind == "mcap"):
        raise ValueError(f"No format named {kind!r} for a folder. Known formats: {', '.join(CLOUD_FORMATS[:-1])}.")
    source = _CloudSource(clouds, progress)
    xyz = "<f8" if float64 else "<f4"
    if is_folder:
        return _write_folder(source, path, kind, voxel, xyz)
    if voxel is not None and kind != "mcap":
        cloud = source.accumulated(voxel)
        return _write_one(path, kind, [] if cloud is None else [cloud], source, xyz)
    each = (c if voxel is None else c._replace(points=thin_points(c.points, voxel)) for c in source)
    return _write_one(path, kind, each, source, xyz)


class _CloudSource:
    """Iterates over clouds and reports progress."""

    def __init__(self, clouds: Clouds, progress: Callable[[int], object]) -> None:
        self.clouds = clouds
        self._progress = progress

    def __iter__(self) -> Any:
        for cloud in self.clouds:
            yield _mark_times(cloud)
            self._progress(self.clouds.messages + sum(self.clouds.skipped.values()))

    def accumulated(self, voxel: float) -> Cloud | None:
        cloud = self.clouds.accumulated(voxel)
        return None if cloud is None else _mark_times(cloud)

    def check_not_empty(self) -> None:
        """Raise an error if no message could be transformed."""
        if self.clouds.messages == 0:
            reasons = "; ".join(self.clouds.skipped) or "the time range contains no messages"
            raise RecordingError(
                f"No message on {self.clouds.topic} can be transformed into {self.clouds.frame}: {reasons}",
                hint=self.clouds.hint or "coframe.bags.summarize() shows which sensor data can be transformed.",
            )


def _mark_times(cloud: Cloud) -> Cloud:
    """Rename the time field of deskewed points, so that no reader deskews them again."""
    names = cloud.points.dtype.names or ()
    if cloud.used_times not in names:
        return cloud
    renamed = {cloud.used_times: f"{DESKEWED_PREFIX}{cloud.used_times}"}
    points = cloud.points.view()
    points.dtype.names = tuple(renamed.get(name, name) for name in names)
    return cloud._replace(points=points)


def _write_folder(source: _CloudSource, folder: Path, kind: str, voxel: float | None, xyz: str) -> int:
    written = 0
    name = source.clouds.topic.strip("/").replace("/", "_")
    for cloud in source:
        folder.mkdir(parents=True, exist_ok=True)
        one = cloud if voxel is None else cloud._replace(points=thin_points(cloud.points, voxel))
        with complete_or_absent(folder / f"{name}_{cloud.stamp}.{kind}") as part, part.open("wb") as stream:
            written += _fill(_WRITERS[kind](stream, xyz), [one])
    source.check_not_empty()
    return written


def _write_one(path: Path, kind: str, clouds: Iterable[Cloud], source: _CloudSource, xyz: str) -> int:
    """Write all clouds to one file atomically."""
    with complete_or_absent(path) as part:
        if kind == "mcap":
            with closing(McapWriter(part)) as bag:
                written = _fill(_BagTopic(bag, source.clouds.topic, xyz), clouds)
        else:
            with part.open("wb") as stream:
                written = _fill(_WRITERS[kind](stream, xyz), clouds)
        source.check_not_empty()
    return written


class _Writer(Protocol):
    def add(self, cloud: Cloud) -> None: ...
    def finish(self) -> None: ...
    def close(self) -> None: ...


def _fill(writer: _Writer, clouds: Iterable[Cloud]) -> int:
    written = 0
    with closing(writer):
        for cloud in clouds:
            writer.add(cloud)
            written += len(cloud.points)
        writer.finish()
    return written


class _Rows:
    """A header followed by points. The header is rewritten at the end with the number of points."""

    def __init__(self, stream: BinaryIO, xyz: str = "<f8") -> None:
        self._stream = stream
        self._coordinate_type = xyz
        self.dtype: np.dtype[Any] | None = None
        self.count = 0

    def add(self, cloud: Cloud) -> None:
        """Add points with the same fields."""
        points = self.rows(cloud.points)
        if self.dtype is None:
            self.dtype = points.dtype
            self._stream.write(self.header(self.dtype, 0))
        elif self.dtype != points.dtype:
            raise ValueError(
                f"The messages have different fields: first {_fields(self.dtype)}, then {_fields(points.dtype)}. "
                "Choose the fields to keep."
            )
        self._stream.write(points.tobytes())
        self.count += len(points)

    def finish(self) -> None:
        """Write the header with the final number of points."""
        if self.dtype is not None:
            self._stream.seek(0)
            self._stream.write(self.header(self.dtype, self.count))

    def close(self) -> None:
        """Release what the writer opened: nothing."""

    def rows(self, points: NDArray[Any]) -> NDArray[Any]:
        """Return the points as the dtypes of the format."""
        return points

    def header(self, dtype: np.dtype[Any], count: int) -> bytes:
        """Return the header for a number of points. Its length is constant."""
        raise NotImplementedError


class _Ply(_Rows):
    """PLY, with coordinates as float64."""

    def rows(self, points: NDArray[Any]) -> NDArray[Any]:
        """Return the points with 64-bit integers as float64, because PLY has no such integers."""
        return _cast(points, {"i8": "<f8", "u8": "<f8"})

    def header(self, dtype: np.dtype[Any], count: int) -> bytes:
        """Return the header in ASCII. A comment pads it to a constant length."""
        kinds = {"i1": "char", "u1": "uchar", "i2": "short", "u2": "ushort", "i4": "int", "u4": "uint"}
        kinds |= {"f4": "float", "f8": "double"}
        digits = str(count)
        lines = ["ply", "format binary_little_endian 1.0", f"comment {'.' * (_MAX_DIGITS - len(digits))}"]
        lines.append(f"element vertex {digits}")
        lines += [f"property {kinds[_type_letters(dtype, name)]} {name}" for name in dtype.names or ()]
        return "\n".join([*lines, "end_header", ""]).encode("ascii", "replace")


class _Pcd(_Rows):
    """PCD, with coordinates as float32, which PCL requires, or as float64."""

    def rows(self, points: NDArray[Any]) -> NDArray[Any]:
        """Return the points with x, y, z as float32 or float64, and colors as PCL packs them."""
        return _cast_coordinates(_pack_colors(points), {}, self._coordinate_type)

    def header(self, dtype: np.dtype[Any], count: int) -> bytes:
        """Return the header of version 0.7. A comment pads it to a constant length."""
        names = dtype.names or ()
        kinds = [_type_letters(dtype, name) for name in names]
        digits = str(count)
        lines = [
            f"# .PCD v0.7 {'.' * (2 * (_MAX_DIGITS - len(digits)))}",
            "VERSION 0.7",
            f"FIELDS {' '.join(names)}",
            f"SIZE {' '.join(kind[1] for kind in kinds)}",
            f"TYPE {' '.join(kind[0].upper() for kind in kinds)}",
            f"COUNT {' '.join('1' for _ in names)}",
            f"WIDTH {digits}",
            "HEIGHT 1",
            "VIEWPOINT 0 0 0 1 0 0 0",
            f"POINTS {digits}",
            "DATA binary",
            "",
        ]
        return "\n".join(lines).encode("ascii", "replace")


class _Npy(_Rows):
    """NumPy's npy, a structured array."""

    def header(self, dtype: np.dtype[Any], count: int) -> bytes:
        """Return the header of version 2.0, padded with spaces to a constant length."""
        text = repr({"descr": dtype.descr, "fortran_order": False, "shape": (count,)})
        longest = _NPY_PREAMBLE_BYTES + len(text) - len(str(count)) + _MAX_DIGITS + 1
        size = -(-longest // 64) * 64 - _NPY_PREAMBLE_BYTES  # the points begin at a multiple of 64
        return b"\x93NUMPY\x02\x00" + size.to_bytes(4, "little") + f"{text:<{size - 1}}\n".encode("ascii", "replace")


class _Npz:
    """NumPy's npz, with one array per field.

    All points are first written to a temporary file, so that only one field is in memory at a time.
    """

    def __init__(self, stream: BinaryIO, _coordinate_type: str = "<f8") -> None:
        self._stream = stream
        self._rows = tempfile.TemporaryFile()  # noqa: SIM115 - closed by close()
        self._npy_file = _Npy(self._rows)

    def add(self, cloud: Cloud) -> None:
        """Add points with the same fields."""
        self._npy_file.add(cloud)

    def finish(self) -> None:
        """Write the arrays."""
        self._npy_file.finish()
        dtype, count = self._npy_file.dtype, self._npy_file.count
        if dtype is None:
            return
        points: Any = np.empty(0, dtype)
        if count:
            points = np.memmap(self._rows, dtype, "r", len(self._npy_file.header(dtype, count)), (count,))
        np.savez(self._stream, **{name: points[name] for name in dtype.names or ()})
        del points  # Closes the memory map.

    def close(self) -> None:
        """Delete the temporary file."""
        self._rows.close()


class _BagTopic:
    """A topic of PointCloud2 messages in a new recording. The caller closes the recording."""

    def __init__(self, writer: McapWriter, topic: str, xyz: str) -> None:
        self._writer = writer
        self._coordinate_type = xyz
        self._channel = writer.add_channel(
            topic,
            POINT_CLOUD,
            encoding="cdr",
            definition=definition_of(POINT_CLOUD),
            definition_format="ros2msg",
            metadata={},
        )

    def add(self, cloud: Cloud) -> None:
        """Write one message, with its stamp as the receive time, in its own chunk because clouds are large."""
        self._writer.write(self._channel, serialize(message_of(cloud, self._coordinate_type)), cloud.stamp, cloud.stamp)
        self._writer.flush()

    def finish(self) -> None:
        """Do nothing. All messages have been written."""

    def close(self) -> None:
        """Do nothing. The caller closes the recording."""


# PointField constants by NumPy type name.
_DATATYPES = {"i1": 1, "u1": 2, "i2": 3, "u2": 4, "i4": 5, "u4": 6, "f4": 7, "f8": 8}


def message_of(cloud: Cloud, xyz: str = "<f4") -> Any:
    """Return a PointCloud2, usually with float32 coordinates, which other tools expect."""
    points = _cast_coordinates(_pack_colors(cloud.points), {"i8": "<f8", "u8": "<f8"}, xyz)
    message, field = find(POINT_CLOUD)(), find("sensor_msgs/msg/PointField")
    message.header.frame_id = cloud.frame
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(cloud.stamp, time.SECOND)
    message.height, message.width = 1, len(points)
    for name in points.dtype.names or ():
        kind, offset = points.dtype.fields[name][:2]  # type: ignore[index]
        message.fields.append(field(name=name, offset=offset, datatype=_DATATYPES[kind.str[1:]], count=1))
    message.point_step, message.row_step = points.itemsize, points.nbytes
    message.data = points.tobytes()
    message.is_dense = True
    return message


def _pack_colors(points: NDArray[Any]) -> NDArray[Any]:
    """Return the points with their color in the field ``rgb``, whose bits are 0x00RRGGBB."""
    names = points.dtype.names or ()
    if not {*_COLORS} <= {*names} or any(points.dtype[name] != np.uint8 for name in _COLORS):
        return points
    others = [name for name in names if name not in {*_COLORS, "rgb"}]
    packed = np.empty(points.shape, [*((name, points.dtype[name]) for name in others), ("rgb", "<f4")])
    for name in others:
        packed[name] = points[name]
    red, green, blue = (points[name].astype("<u4") for name in _COLORS)
    packed["rgb"] = (red << 16 | green << 8 | blue).view("<f4")
    return packed


def _type_letters(dtype: np.dtype[Any], name: str) -> str:
    return str(dtype[name].str[1:])


def _fields(dtype: np.dtype[Any]) -> str:
    return ", ".join(f"{name} ({dtype[name]})" for name in dtype.names or ())


def _cast_coordinates(points: NDArray[Any], kinds: dict[str, str], xyz: str) -> NDArray[Any]:
    """Call :func:`_cast`, and warn if it rounds coordinates."""
    result = _cast(points, kinds, xyz=xyz)
    position = (result["x"], result["y"], result["z"])
    warn_of_rounding(largest_coordinate(position), position, _FLOAT64_ADVICE)
    return result


def _cast(points: NDArray[Any], kinds: dict[str, str], *, xyz: str = "<f8") -> NDArray[Any]:
    """Return the points with other dtypes, and with field names that an ASCII header can contain."""
    dtype = np.dtype(
        [
            ("".join(c if c.isascii() and c.isprintable() and c != " " else "_" for c in name), kind)
            for name, kind in (
                (
                    name,
                    xyz
                    if name in {"x", "y", "z"}
                    else kinds.get(_type_letters(points.dtype, name), points.dtype[name].str),
                )
                for name in points.dtype.names or ()
            )
        ]
    )
    return points.astype(dtype)


_WRITERS: dict[str, Callable[[BinaryIO, str], _Writer]] = {"ply": _Ply, "pcd": _Pcd, "npz": _Npz, "npy": _Npy}
