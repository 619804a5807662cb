"""Clouds as files: PLY, PCD, numpy's npy and npz, a folder of them, or a new recording."""

from __future__ import annotations

import tempfile
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, Protocol

import numpy as np

from coframe.bags.definitions import definition_of
from coframe.bags.mcap_writer import McapWriter
from coframe.errors import RecordingError
from coframe.messages import find, serialize
from coframe.sensors.thinning import thinned

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from coframe.bags.clouds import Cloud, Clouds

__all__ = ["CLOUD_FORMATS", "write_clouds"]

CLOUD_FORMATS = ("ply", "pcd", "npz", "npy", "mcap")
_TYPE = "sensor_msgs/msg/PointCloud2"
_MOST_DIGITS = 20  # room for a count that is known in the end only
_NPY_HEAD = 12  # bytes before the text of numpy's header


def write_clouds(
    clouds: Clouds,
    target: str | os.PathLike[str],
    *,
    format_: str | None = None,
    voxel: float | None = None,
    progress: Callable[[int], object] = lambda _count: None,
) -> int:
    """Writes the points of all messages, as they are read: it takes no more memory for many messages than for one.

    Args:
        clouds: What to write.
        target: A file that ends with ``.ply``, ``.pcd``, ``.npz`` or ``.npy`` gets all points as one cloud, one that
            ends with ``.mcap`` is a new recording with a PointCloud2 for each message; all else is a folder, which
            gets a file for each message, named by its stamp.
        format_: Of the files in a folder: ``"ply"`` (the default), ``"pcd"``, ``"npz"`` or ``"npy"``.
        voxel: Keep the first point in each cube of so many metres; in one cloud, memory for the points that are left.
        progress: Called with the number of messages that have been dealt with.

    Returns:
        How many points were written.

    Raises:
        RecordingError: No message gave points; or a package is not installed.
        ValueError: There is no such format, or the messages do not have the same fields.
        OSError: It cannot be written.
    """
    path = Path(target)
    suffix = path.suffix.lower().removeprefix(".")
    is_folder = suffix not in CLOUD_FORMATS or path.is_dir()
    kind = (format_ or "ply") if is_folder else suffix
    if is_folder and suffix and format_ is None and not path.is_dir():
        raise ValueError(
            f"there is no format {suffix!r}: files end with one of {', '.join(CLOUD_FORMATS)}, folders with none"
        )
    if kind not in CLOUD_FORMATS or (is_folder and kind == "mcap"):
        raise ValueError(f"there is no format {kind!r} for a folder: it is one of {', '.join(CLOUD_FORMATS[:-1])}")
    told = _Told(clouds, progress)
    if is_folder:
        return _write_folder(told, path, kind, voxel)
    if voxel is not None and kind != "mcap":
        cloud = told.accumulated(voxel)
        return _write_one(path, kind, [] if cloud is None else [cloud], told)
    each = (c if voxel is None else c._replace(points=thinned(c.points, voxel)) for c in told)
    return _write_one(path, kind, each, told)


class _Told:
    """Clouds whose progress is told of."""

    def __init__(self, clouds: Clouds, progress: Callable[[int], object]) -> None:
        self.clouds = clouds
        self._progress = progress

    def __iter__(self) -> Any:
        for cloud in self.clouds:
            yield cloud
            self._progress(self.clouds.messages + sum(self.clouds.left_out.values()))

    def accumulated(self, voxel: float) -> Cloud | None:
        return self.clouds.accumulated(voxel)

    def check_some(self) -> None:
        """Raises where no message gave points."""
        if self.clouds.messages == 0:
            reasons = "; ".join(self.clouds.left_out) or "there is no message in that time"
            raise RecordingError(
                f"nothing of {self.clouds.topic} could be seen from {self.clouds.frame}: {reasons}",
                hint=self.clouds.hint or "`coframe bag info` tells which sensors can be transformed.",
            )


def _write_folder(told: _Told, folder: Path, kind: str, voxel: float | None) -> int:
    written = 0
    name = told.clouds.topic.strip("/").replace("/", "_")
    for cloud in told:
        folder.mkdir(parents=True, exist_ok=True)
        one = cloud if voxel is None else cloud._replace(points=thinned(cloud.points, voxel))
        with (folder / f"{name}_{cloud.stamp}.{kind}").open("wb") as stream:
            written += _fill(_WRITERS[kind](stream), [one])
    told.check_some()
    return written


def _write_one(path: Path, kind: str, clouds: Iterable[Cloud], told: _Told) -> int:
    """All clouds in one file, which is there in the end only if it is whole."""
    temporary = path.with_name(f".{path.name}.part")
    temporary.unlink(missing_ok=True)  # of somebody who was killed
    try:
        if kind == "mcap":
            with closing(McapWriter(temporary)) as bag:
                written = _fill(_NewBag(bag, told.clouds.topic), clouds)
        else:
            with temporary.open("wb") as stream:
                written = _fill(_WRITERS[kind](stream), clouds)
        told.check_some()
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
    return written


class _Writer(Protocol):
    def add(self, cloud: Cloud) -> None: ...
    def finish(self) -> None: ...


def _fill(writer: _Writer, clouds: Iterable[Cloud]) -> int:
    written = 0
    for cloud in clouds:
        writer.add(cloud)
        written += len(cloud.points)
    writer.finish()
    return written


class _Rows:
    """Points in a row behind a header, which is written again with their number when that is known."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self.dtype: np.dtype[Any] | None = None
        self.count = 0

    def add(self, cloud: Cloud) -> None:
        """More points, with the same fields."""
        points = self.rows(cloud.points)
        if self.dtype is None:
            self.dtype = points.dtype
            self._stream.write(self.header(self.dtype, 0))
        elif self.dtype != points.dtype:
            raise ValueError(
                f"the messages have different fields, first {_fields(self.dtype)}, now {_fields(points.dtype)}: "
                "name those to keep"
            )
        self._stream.write(points.tobytes())
        self.count += len(points)

    def finish(self) -> None:
        """Writes the header as it must be."""
        if self.dtype is not None:
            self._stream.seek(0)
            self._stream.write(self.header(self.dtype, self.count))

    def rows(self, points: NDArray[Any]) -> NDArray[Any]:
        """The points as the format has them."""
        return points

    def header(self, dtype: np.dtype[Any], count: int) -> bytes:
        """For so many points; its length does not depend on the number."""
        raise NotImplementedError


class _Ply(_Rows):
    """Coordinates stay float64."""

    def rows(self, points: NDArray[Any]) -> NDArray[Any]:
        """PLY has no integers of 64 bits."""
        return _cast(points, {"i8": "<f8", "u8": "<f8"})

    def header(self, dtype: np.dtype[Any], count: int) -> bytes:
        """In ASCII; the comment fills up what the number leaves."""
        kinds = {"i1": "char", "u1": "uchar", "i2": "short", "u2": "ushort", "i4": "int", "u4": "uint"}
        kinds |= {"f4": "float", "f8": "double"}
        digits = str(count)
        lines = ["ply", "format binary_little_endian 1.0", f"comment {'.' * (_MOST_DIGITS - len(digits))}"]
        lines.append(f"element vertex {digits}")
        lines += [f"property {kinds[_kind(dtype, name)]} {name}" for name in dtype.names or ()]
        return "\n".join([*lines, "end_header", ""]).encode("ascii", "replace")


class _Pcd(_Rows):
    """Coordinates become float32, which is what PCL reads as points."""

    def rows(self, points: NDArray[Any]) -> NDArray[Any]:
        """With x, y, z as float32."""
        return _cast(points, {}, xyz="<f4")

    def header(self, dtype: np.dtype[Any], count: int) -> bytes:
        """Version 0.7; the comment fills up what the numbers leave."""
        names = dtype.names or ()
        kinds = [_kind(dtype, name) for name in names]
        digits = str(count)
        lines = [
            f"# .PCD v0.7 {'.' * (2 * (_MOST_DIGITS - len(digits)))}",
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
    """A structured array."""

    def header(self, dtype: np.dtype[Any], count: int) -> bytes:
        """Version 2.0 of the format, filled up with blanks."""
        text = repr({"descr": dtype.descr, "fortran_order": False, "shape": (count,)})
        longest = _NPY_HEAD + len(text) - len(str(count)) + _MOST_DIGITS + 1
        size = -(-longest // 64) * 64 - _NPY_HEAD  # the points begin at a multiple of 64
        return b"\x93NUMPY\x02\x00" + size.to_bytes(4, "little") + f"{text:<{size - 1}}\n".encode("ascii", "replace")


class _Npz:
    """An array for each field, by way of a file of all of them: only one is in memory at a time."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self._rows = tempfile.TemporaryFile()  # noqa: SIM115 - closed by finish()
        self._npy = _Npy(self._rows)

    def add(self, cloud: Cloud) -> None:
        """More points, with the same fields."""
        self._npy.add(cloud)

    def finish(self) -> None:
        """Writes the arrays."""
        self._npy.finish()
        with self._rows as rows:
            dtype, count = self._npy.dtype, self._npy.count
            if dtype is None:
                return
            points: Any = np.empty(0, dtype)
            if count:
                points = np.memmap(rows, dtype, "r", len(self._npy.header(dtype, count)), (count,))
            np.savez(self._stream, **{name: points[name] for name in dtype.names or ()})
            del points  # lets go of the file


class _NewBag:
    """A topic of PointCloud2 in a new recording, which is somebody else's to close."""

    def __init__(self, writer: McapWriter, topic: str) -> None:
        self._writer = writer
        self._channel = writer.add_channel(
            topic,
            _TYPE,
            encoding="cdr",
            definition=definition_of(_TYPE),
            definition_format="ros2msg",
            metadata={},
        )

    def add(self, cloud: Cloud) -> None:
        """One message, received at its own stamp, and a chunk of its own: clouds are large."""
        self._writer.write(self._channel, serialize(message_of(cloud)), cloud.stamp, cloud.stamp)
        self._writer.flush()

    def finish(self) -> None:
        """There is nothing left to write."""


# By their names in numpy.
_DATATYPES = {"i1": 1, "u1": 2, "i2": 3, "u2": 4, "i4": 5, "u4": 6, "f4": 7, "f8": 8}


def message_of(cloud: Cloud) -> Any:
    """A PointCloud2 with the coordinates as float32, which is what others read."""
    points = _cast(cloud.points, {"i8": "<f8", "u8": "<f8"}, xyz="<f4")
    message, field = find(_TYPE)(), find("sensor_msgs/msg/PointField")
    message.header.frame_id = cloud.frame
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(cloud.stamp, 1_000_000_000)
    message.height, message.width = 1, len(points)
    for name in points.dtype.names or ():
        kind, offset = points.dtype.fields[name][:2]  # type: ignore[index]
        message.fields.append(field(name=name, offset=offset, datatype=_DATATYPES[kind.str[1:]], count=1))
    message.point_step, message.row_step = points.itemsize, points.nbytes
    message.data = points.tobytes()
    message.is_dense = True
    return message


def _kind(dtype: np.dtype[Any], name: str) -> str:
    return str(dtype[name].str[1:])


def _fields(dtype: np.dtype[Any]) -> str:
    return ", ".join(f"{name} ({dtype[name]})" for name in dtype.names or ())


def _cast(points: NDArray[Any], kinds: dict[str, str], *, xyz: str = "<f8") -> NDArray[Any]:
    """With other types, and names that a header in ASCII can hold."""
    dtype = np.dtype(
        [
            ("".join(c if c.isascii() and c.isprintable() and c != " " else "_" for c in name), kind)
            for name, kind in (
                (name, xyz if name in {"x", "y", "z"} else kinds.get(_kind(points.dtype, name), points.dtype[name].str))
                for name in points.dtype.names or ()
            )
        ]
    )
    return points.astype(dtype)


_WRITERS: dict[str, Callable[[BinaryIO], _Writer]] = {"ply": _Ply, "pcd": _Pcd, "npz": _Npz, "npy": _Npy}
