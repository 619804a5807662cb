"""Trajectories as files: TUM, KITTI, CSV, Parquet and numpy's npz."""

from __future__ import annotations

import importlib
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

import numpy as np

from coframe import time
from coframe.bags.table import POSE_COLUMNS
from coframe.errors import RecordingError

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator
    from contextlib import AbstractContextManager

    from numpy.typing import NDArray

    from coframe.transform import Transform

__all__ = ["FORMATS", "format_of", "write_trajectory"]

_SUFFIXES = {".tum": "tum", ".txt": "tum", ".kitti": "kitti", ".csv": "csv", ".parquet": "parquet", ".npz": "npz"}
FORMATS = ("tum", "kitti", "csv", "parquet", "npz")


def format_of(path: str | os.PathLike[str]) -> str:
    """The format that a file's name stands for.

    Raises:
        ValueError: It stands for none.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in _SUFFIXES:
        raise ValueError(f"{str(path)!r} does not say which format: end it with one of {', '.join(_SUFFIXES)}")
    return _SUFFIXES[suffix]


def write_trajectory(poses: Transform, target: str | os.PathLike[str] | TextIO, format_: str | None = None) -> None:
    """Writes a batch of poses with stamps, as :meth:`coframe.Buffer.trajectory` and ``lookup_many`` give it.

    Args:
        poses: Shape (N,), with stamps. Rows without an answer (NaN) are to be left out before.
        target: A file's name, or a stream of text for the formats of text.
        format_: ``tum`` (seconds x y z qx qy qz qw), ``kitti`` (the upper three rows of the matrix, no times), ``csv``
            (with the nanoseconds), ``parquet`` or ``npz``; None: as the name ends.

    Raises:
        ValueError: There is no such format, or it is none of text and ``target`` is a stream, or there are no stamps.
        RecordingError: pyarrow is not installed.
    """
    kind = format_ or (format_of(target) if not hasattr(target, "write") else "tum")
    if kind not in FORMATS:
        raise ValueError(f"there is no format {kind!r}: it is one of {', '.join(FORMATS)}")
    if poses.stamps is None or len(poses.shape) != 1:
        raise ValueError("a trajectory is a batch of shape (N,) with stamps")
    values = np.concatenate([poses.translation, poses.quaternion], axis=1)
    if kind in _TEXT:
        with _stream(target) as stream:
            stream.writelines(f"{line}\n" for line in _TEXT[kind](poses.stamps, values, poses))
    elif hasattr(target, "write"):
        raise ValueError(f"{kind} is no text: name a file")
    elif kind == "npz":
        with Path(target).open("wb") as file:
            np.savez(
                file,
                stamps=poses.stamps,
                translation=values[:, :3],
                quaternion=values[:, 3:],
                target=np.array(poses.target or ""),
                source=np.array(poses.source or ""),
            )
    else:
        _write_parquet(poses, poses.stamps, values, Path(target))


def _stream(target: Any) -> AbstractContextManager[TextIO]:
    return nullcontext(target) if hasattr(target, "write") else Path(target).open("w", encoding="utf-8")


def _tum(stamps: NDArray[np.int64], values: NDArray[np.float64], _poses: Transform) -> Iterator[str]:
    for stamp, row in zip(stamps.tolist(), values.tolist(), strict=True):
        yield f"{_seconds(stamp)} {' '.join(map(repr, row))}"


def _kitti(_stamps: NDArray[np.int64], _values: NDArray[np.float64], poses: Transform) -> Iterator[str]:
    for row in poses.matrix[:, :3].reshape(-1, 12).tolist():
        yield " ".join(map(repr, row))


def _csv(stamps: NDArray[np.int64], values: NDArray[np.float64], _poses: Transform) -> Iterator[str]:
    yield ",".join(("stamp_ns", *POSE_COLUMNS))
    for stamp, row in zip(stamps.tolist(), values.tolist(), strict=True):
        yield f"{stamp},{','.join(map(repr, row))}"


_TEXT = {"tum": _tum, "kitti": _kitti, "csv": _csv}


def _seconds(stamp: int) -> str:
    """All nine digits: a float of seconds would lose some."""
    sign, size = ("-", -stamp) if stamp < 0 else ("", stamp)
    return f"{sign}{size // time.SECOND}.{size % time.SECOND:09d}"


def _write_parquet(poses: Transform, stamps: NDArray[np.int64], values: NDArray[np.float64], path: Path) -> None:
    try:
        arrow: Any = importlib.import_module("pyarrow")
        parquet: Any = importlib.import_module("pyarrow.parquet")
    except ModuleNotFoundError:
        raise RecordingError("Parquet needs the package pyarrow", hint="pip install 'coframe[parquet]'") from None
    columns = {name: values[:, i] for i, name in enumerate(POSE_COLUMNS)}
    table = arrow.table({"stamp_ns": stamps, **columns})
    about = {"target": poses.target or "", "source": poses.source or ""}
    parquet.write_table(table.replace_schema_metadata(about), path)
