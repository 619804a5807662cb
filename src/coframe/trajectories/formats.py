# SPDX-License-Identifier: Apache-2.0
"""Write trajectory files: TUM, KITTI, EuRoC, CSV, Parquet and NumPy's npz."""

from __future__ import annotations

import importlib
from contextlib import contextmanager, nullcontext
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

import numpy as np

from coframe._files.complete_files import complete_or_absent
from coframe._output.formatting import seconds
from coframe._process.optional_imports import pip_install
from coframe.errors import RecordingError
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Iterator, Mapping
    from contextlib import AbstractContextManager

    from numpy.typing import NDArray

__all__ = [
    "EUROC_HEADER",
    "FORMATS",
    "FORMATS_WITH_COLUMNS",
    "POSE_COLUMNS",
    "TRAJECTORY_SUFFIXES",
    "format_of",
    "write_trajectory",
]

POSE_COLUMNS = ("x", "y", "z", "qx", "qy", "qz", "qw")
# The header line of the EuRoC data set.
EUROC_HEADER = "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []"
FORMATS = ("tum", "kitti", "euroc", "csv", "parquet", "npz")
FORMATS_WITH_COLUMNS = ("csv", "parquet", "npz")
_SUFFIXES = {
    ".tum": "tum",
    ".txt": "tum",
    ".kitti": "kitti",
    ".euroc": "euroc",
    ".csv": "csv",
    ".parquet": "parquet",
    ".npz": "npz",
}
TRAJECTORY_SUFFIXES = frozenset(_SUFFIXES) - {".parquet"}  # of files that can be read
# Text takes twenty times as much memory as numbers, so only this many rows are formatted at once.
_ROWS_PER_BATCH = 10_000
_Rows = tuple[Transform, "Mapping[str, NDArray[np.int64]]"]  # poses, and more columns


def format_of(path: str | os.PathLike[str]) -> str:
    """Return the format for a file name.

    Raises:
        ValueError: The suffix is unknown.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in _SUFFIXES:
        raise ValueError(f"Unknown suffix of {str(path)!r}. Known suffixes: {', '.join(_SUFFIXES)}.")
    return _SUFFIXES[suffix]


def write_trajectory(
    poses: Transform | Iterable[Transform],
    target: str | os.PathLike[str] | TextIO,
    format_: str | None = None,
    *,
    progress: Callable[[int], object] | None = None,
    columns: Callable[[Transform], Mapping[str, NDArray[np.int64]]] | None = None,
) -> None:
    """Write a batch of stamped poses to a file.

    If writing fails or is interrupted, no partial file is left.

    Args:
        poses: Transforms of shape (N,) with stamps, as returned by :meth:`coframe.Buffer.trajectory` and
            ``lookup_many``. Remove rows without a result (NaN) first. Or an iterable of such batches, at least one,
            which are written one after the other; except for ``npz``, only one of them is in memory at a time.
        target: A file name, or a text stream for the text formats.
        format_: ``tum`` (seconds x y z qx qy qz qw), ``kitti`` (upper three rows of the matrix, no times), ``euroc``
            (stamps in nanoseconds, x, y, z, qw, qx, qy, qz), ``csv`` (stamps in nanoseconds, columns with names),
            ``parquet`` or ``npz``; None chooses it by the suffix of the file name, or ``tum`` for a stream.
        progress: Called regularly with the number of poses written.
        columns: Returns more columns for a batch, (N,) each; only for ``csv``, ``parquet`` and ``npz``.

    Raises:
        ValueError: The format is unknown, has no more columns, or is not a text format although ``target`` is a stream,
            or there are no stamps.
        RecordingError: pyarrow is not installed.
    """
    kind = format_ or (format_of(target) if not hasattr(target, "write") else "tum")
    if kind not in FORMATS:
        raise ValueError(f"No format named {kind!r}. Known formats: {', '.join(FORMATS)}.")
    if columns is not None and kind not in FORMATS_WITH_COLUMNS:
        raise ValueError(f"{kind} has a fixed number of columns. Formats: {', '.join(FORMATS_WITH_COLUMNS)}.")
    batches = _check_batches([poses] if isinstance(poses, Transform) else poses)
    first = next(batches, None)
    if first is None:
        raise ValueError("A trajectory needs at least one batch of poses; the iterable has none.")
    batches = _report_progress(chain([first], batches), progress or (lambda _written: None))
    rows = ((batch, {} if columns is None else columns(batch)) for batch in batches)
    if kind in _TEXT_WRITERS:
        with _open_text_stream(target) as stream:
            for number, (batch, others) in enumerate(rows):
                if kind in _HEADERS and number == 0:
                    stream.write(",".join([_HEADERS[kind], *others]) + "\n")
                lines = _TEXT_WRITERS[kind](batch)
                if others:
                    more = zip(*(values.tolist() for values in others.values()), strict=True)
                    lines = (",".join([line, *map(str, each)]) for line, each in zip(lines, more, strict=True))
                stream.writelines(f"{line}\n" for line in lines)
    elif hasattr(target, "write"):
        raise ValueError(f"{kind} is not a text format and cannot be written to a text stream: give a file name.")
    elif kind == "npz":
        _write_npz(list(rows), Path(target))
    else:
        _write_parquet(rows, Path(target))


def _check_batches(batches: Iterable[Transform]) -> Iterator[Transform]:
    for poses in batches:
        if poses.stamps is None or len(poses.shape) != 1:
            stamps = "no stamps" if poses.stamps is None else "stamps"
            raise ValueError(
                f"A trajectory must have shape (N,) and stamps; this one has shape {poses.shape} and {stamps}."
            )
        yield poses


def _report_progress(batches: Iterable[Transform], progress: Callable[[int], object]) -> Iterator[Transform]:
    """Yield the batches in parts of at most `_ROWS_PER_BATCH` rows, and report how many have been written."""
    written = 0
    for poses in batches:
        for start in range(0, len(poses), _ROWS_PER_BATCH):
            part = poses if len(poses) <= _ROWS_PER_BATCH else poses[start : start + _ROWS_PER_BATCH]
            yield part
            written += len(part)
            progress(written)
        if not len(poses):
            yield poses


def _open_text_stream(target: Any) -> AbstractContextManager[TextIO]:
    if hasattr(target, "write"):
        return nullcontext(target)
    return _text_file(Path(target))


@contextmanager
def _text_file(path: Path) -> Iterator[TextIO]:
    with complete_or_absent(path) as name, name.open("w", encoding="utf-8") as stream:
        yield stream


def _format_tum(poses: Transform) -> Iterator[str]:
    for stamp, row in zip(_stamps(poses).tolist(), _values(poses).tolist(), strict=True):
        yield f"{seconds(stamp)} {' '.join(map(repr, row))}"


def _format_kitti(poses: Transform) -> Iterator[str]:
    for row in poses.matrix[:, :3].reshape(-1, 12).tolist():
        yield " ".join(map(repr, row))


def _format_csv(poses: Transform) -> Iterator[str]:
    for stamp, row in zip(_stamps(poses).tolist(), _values(poses).tolist(), strict=True):
        yield f"{stamp},{','.join(map(repr, row))}"


def _format_euroc(poses: Transform) -> Iterator[str]:
    values = _values(poses)[:, (0, 1, 2, 6, 3, 4, 5)]
    for stamp, row in zip(_stamps(poses).tolist(), values.tolist(), strict=True):
        yield f"{stamp},{','.join(map(repr, row))}"


_TEXT_WRITERS = {"tum": _format_tum, "kitti": _format_kitti, "euroc": _format_euroc, "csv": _format_csv}
_HEADERS = {"csv": ",".join(("stamp_ns", *POSE_COLUMNS)), "euroc": EUROC_HEADER}


def _stamps(poses: Transform) -> NDArray[np.int64]:
    return np.asarray(poses.stamps, dtype=np.int64)


def _values(poses: Transform) -> NDArray[np.float64]:
    return np.concatenate([poses.translation, poses.quaternion], axis=1)


def _write_npz(rows: list[_Rows], path: Path) -> None:
    parts = [part for part, _ in rows]
    more: dict[str, Any] = {name: np.concatenate([others[name] for _, others in rows]) for name in rows[0][1]}
    with complete_or_absent(path) as name, name.open("wb") as file:
        np.savez(
            file,
            stamps=np.concatenate([_stamps(part) for part in parts]),
            translation=np.concatenate([part.translation for part in parts]),
            quaternion=np.concatenate([part.quaternion for part in parts]),
            target=np.array(parts[0].target or ""),
            source=np.array(parts[0].source or ""),
            **more,
        )


def _write_parquet(rows: Iterator[_Rows], path: Path) -> None:
    try:
        arrow: Any = importlib.import_module("pyarrow")
        parquet: Any = importlib.import_module("pyarrow.parquet")
    except ModuleNotFoundError:
        raise RecordingError(
            "Parquet needs the package pyarrow, which is not installed", hint=pip_install("parquet")
        ) from None
    writer: Any = None
    with complete_or_absent(path) as name:
        try:
            for poses, others in rows:
                values = _values(poses)
                columns = {column: values[:, i] for i, column in enumerate(POSE_COLUMNS)}
                table = arrow.table({"stamp_ns": _stamps(poses), **columns, **others})
                about = {"target": poses.target or "", "source": poses.source or ""}
                table = table.replace_schema_metadata(about)
                writer = writer or parquet.ParquetWriter(name, table.schema)
                writer.write_table(table)
        finally:
            if writer is not None:
                writer.close()
