# SPDX-License-Identifier: Apache-2.0
"""Write tables to files: Parquet, Arrow, CSV and NumPy's npz."""

from __future__ import annotations

import csv
import importlib
import json
from contextlib import contextmanager, nullcontext
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

import numpy as np

from coframe._files.complete_files import complete_or_absent
from coframe._output.formatting import did_you_mean
from coframe._process.optional_imports import pip_install
from coframe.bags.tables.table import Table
from coframe.errors import RecordingError

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Iterator

    from numpy.typing import NDArray

__all__ = ["TABLE_FORMATS", "table_format", "write_table"]

TABLE_FORMATS = ("parquet", "arrow", "csv", "npz")
_SUFFIXES = {".parquet": "parquet", ".arrow": "arrow", ".feather": "arrow", ".csv": "csv", ".npz": "npz"}


def table_format(path: str | os.PathLike[str]) -> str:
    """Return the format for a file name.

    Raises:
        RecordingError: The suffix is unknown.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in _SUFFIXES:
        hint = f"{did_you_mean(suffix, _SUFFIXES)} Suffixes of tables: {', '.join(_SUFFIXES)}.".lstrip()
        raise RecordingError(f"unknown suffix of {str(path)!r}", hint=hint)
    return _SUFFIXES[suffix]


def write_table(
    parts: Table | Iterable[Table], target: str | os.PathLike[str] | TextIO, format_: str | None = None
) -> int:
    """Write a table to a file, with a column for each value.

    If writing fails or is interrupted, no partial file is left.

    Args:
        parts: A table, or parts with the same columns, at least one, as returned by :meth:`TableQuery.batches`; except
            for ``npz``, only one of them is in memory at a time.
        target: A file name, or a text stream for ``csv``.
        format_: ``parquet``, ``arrow`` (an Arrow IPC file, as Feather), ``csv`` or ``npz``; None chooses it by the
            suffix of the file name, or ``csv`` for a stream.

    Returns:
        The number of rows.

    Raises:
        RecordingError: The format is unknown or cannot store the columns, or pyarrow is not installed.
        OSError: The file cannot be written.
    """
    kind = format_ or ("csv" if hasattr(target, "write") else table_format(target))
    if kind not in TABLE_FORMATS:
        hint = f"{did_you_mean(kind, TABLE_FORMATS)} Formats: {', '.join(TABLE_FORMATS)}.".lstrip()
        raise RecordingError(f"no format named {kind!r}", hint=hint)
    tables = iter([parts] if isinstance(parts, Table) else parts)
    if kind == "csv":
        with _text_stream(target) as stream:
            return _write_csv(tables, stream)
    if hasattr(target, "write"):
        raise RecordingError(f"{kind} is not a text format and cannot be written to a text stream")
    with complete_or_absent(target) as path:
        return _write_npz(tables, path) if kind == "npz" else _write_arrow(tables, path, kind)


@contextmanager
def _text_file(target: Any) -> Iterator[TextIO]:
    with complete_or_absent(target) as path, path.open("w", encoding="utf-8", newline="") as stream:
        yield stream


def _text_stream(target: Any) -> Any:
    return nullcontext(target) if hasattr(target, "write") else _text_file(target)


def _write_csv(tables: Iterator[Table], stream: TextIO) -> int:
    rows = 0
    writer = csv.writer(stream, lineterminator="\n")
    for table in tables:
        values = list(table.expanded())
        if not rows:
            writer.writerow(["stamp_ns", *(name for name, *_ in values)])
        cells = [_cells(leaf.kind, array, known) for _, leaf, array, known in values]
        writer.writerows(zip(table.stamps.tolist(), *cells, strict=True))
        rows += len(table)
    return rows


def _cells(kind: str, array: NDArray[Any], known: NDArray[np.bool_]) -> list[Any]:
    """Return the values as CSV stores them; missing ones are empty."""
    if kind == "boolean":
        values: list[Any] = [str(value).lower() for value in array.tolist()]
    elif array.dtype.kind == "O" and kind != "text":
        values = [_as_json(value) for value in array]
    elif array.dtype == np.float32:
        values = [str(value) for value in array]
    else:
        values = array.tolist()
    return [value if is_known else "" for value, is_known in zip(values, known.tolist(), strict=True)]


def _as_json(value: Any) -> str:
    if isinstance(value, bytes):
        return value.hex()
    return json.dumps(value.tolist() if isinstance(value, np.ndarray) else value, default=_to_builtin)


def _to_builtin(value: Any) -> Any:
    """Return a message as a dictionary, and a sequence as a list."""
    if hasattr(value, "get_fields_and_field_types"):
        return {name: getattr(value, name) for name in value.get_fields_and_field_types()}
    return value.hex() if isinstance(value, bytes) else list(value)


def _write_npz(tables: Iterator[Table], path: Path) -> int:
    table = Table.joined(list(tables))
    arrays: dict[str, NDArray[Any]] = {}
    for name, array in table.to_numpy().items():
        if array.dtype.kind == "O":
            if not all(isinstance(value, str) or value is None for value in array):
                raise RecordingError(
                    f"npz cannot store {name}, whose values are sequences", hint="Write Parquet, Arrow or CSV."
                )
            array = np.array(["" if value is None else value for value in array], dtype=str)  # noqa: PLW2901
        arrays[name] = np.ma.getdata(array)
    with path.open("wb") as file:
        np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # a name cannot be "file"
    return len(table)


def _write_arrow(tables: Iterator[Table], path: Path, kind: str) -> int:
    try:
        arrow: Any = importlib.import_module("pyarrow")
        parquet: Any = importlib.import_module("pyarrow.parquet")
    except ModuleNotFoundError:
        raise RecordingError(
            f"{kind} needs the package pyarrow, which is not installed", hint=pip_install("parquet")
        ) from None
    first = next(tables)
    schema = first.to_arrow(flat=True).schema
    rows = 0
    writer = parquet.ParquetWriter(path, schema) if kind == "parquet" else arrow.ipc.new_file(str(path), schema)
    with writer:
        for table in chain([first], tables):
            writer.write_table(table.to_arrow(flat=True))
            rows += len(table)
    return rows
