"""Trajectory files: TUM, KITTI, CSV, Parquet and NumPy's npz."""

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
    """Return the format for a file name.

    Raises:
        ValueError: The suffix does not belong to a known format.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in _SUFFIXES:
        raise ValueError(f"Unknown suffix of {str(path)!r}. Known suffixes: {', '.join(_SUFFIXES)}.")
    return _SUFFIXES[suffix]


def write_trajectory(poses: Transform, target: str | os.PathLike[str] | TextIO, format_: str | None = None) -> None:
    """Write a batch of stamped poses to a file.

    Args:
        poses: Transforms of shape (N,) with stamps, as returned by :meth:`coframe.Buffer.trajectory` and
            ``lookup_many``. Remove rows without a result (NaN) first.
        target: A file name, or a text stream for the text formats.
        format_: ``tum`` (seconds x y z qx qy qz qw), ``kitti`` (upper three rows of the matrix, no times), ``csv``
            (stamps in nanoseconds), ``parquet`` or ``npz``; None: by the suffix of the file name, or ``tum`` for a
            stream.

    Raises:
        ValueError: The format is unknown or not a text format although ``target`` is a stream, or there are no stamps.
        RecordingError: pyarrow is not installed.
    """
    kind = format_ or (format_of(target) if not hasattr(target, "write") else "tum")
    if kind not in FORMATS:
        raise ValueError(f"No format named {kind!r}. Known formats: {', '.join(FORMATS)}.")
    if poses.stamps is None or len(poses.shape) != 1:
        stamps = "no stamps" if poses.stamps is None else "stamps"
        raise ValueError(
            f"A trajectory must have shape (N,) and stamps; this one has shape {poses.shape} and {stamps}."
        )
    values = np.concatenate([poses.translation, poses.quaternion], axis=1)
    if kind in _TEXT:
        with _stream(target) as stream:
            stream.writelines(f"{line}\n" for line in _TEXT[kind](poses.stamps, values, poses))
    elif hasattr(target, "write"):
        raise ValueError(f"{kind} is not a text format and cannot be written to a text stream: give a file name.")
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
    """Format nanoseconds as seconds with nine decimals, which a float would round."""
    sign, absolute = ("-", -stamp) if stamp < 0 else ("", stamp)
    return f"{sign}{absolute // time.SECOND}.{absolute % time.SECOND:09d}"


def _write_parquet(poses: Transform, stamps: NDArray[np.int64], values: NDArray[np.float64], path: Path) -> None:
    try:
        arrow: Any = importlib.import_module("pyarrow")
        parquet: Any = importlib.import_module("pyarrow.parquet")
    except ModuleNotFoundError:
        raise RecordingError(
            "Parquet needs the package pyarrow, which is not installed", hint="pip install 'coframe[parquet]'"
        ) from None
    columns = {name: values[:, i] for i, name in enumerate(POSE_COLUMNS)}
    table = arrow.table({"stamp_ns": stamps, **columns})
    about = {"target": poses.target or "", "source": poses.source or ""}
    parquet.write_table(table.replace_schema_metadata(about), path)
