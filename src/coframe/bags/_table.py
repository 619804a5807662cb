# SPDX-License-Identifier: Apache-2.0
"""All transforms of a recording as one table, for pyarrow and pandas."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe import _core
from coframe._process.optional_imports import pip_install
from coframe.errors import RecordingError
from coframe.trajectories.formats import POSE_COLUMNS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from coframe.buffer import Buffer, EdgeInfo

__all__ = ["edge_table"]


class _NameColumn:
    """A dictionary-encoded column of names: one code per row, and the name for each code."""

    def __init__(self, rows: int) -> None:
        self.codes = np.empty(rows, dtype=np.int32)
        self._numbers: dict[str, int] = {}

    def code(self, name: str) -> int:
        """Return the code of a name; assign a new one if needed."""
        return self._numbers.setdefault(name, len(self._numbers))

    @property
    def names(self) -> list[str]:
        """The names in the order of their codes."""
        return list(self._numbers)


class _Columns(NamedTuple):
    """The columns of the table, one edge after the other."""

    stamps: NDArray[np.int64]
    parent: _NameColumn
    child: _NameColumn
    poses: NDArray[np.float64]  # (7, N)
    static: NDArray[np.bool_]
    topic: _NameColumn


def edge_table(buffers: Iterable[Buffer], format_: str = "arrow") -> Any:
    """Return every sample of every edge as a table.

    Args:
        buffers: The buffers that contain the samples.
        format_: ``"arrow"`` for a ``pyarrow.Table``, ``"pandas"`` for a ``DataFrame``.

    Returns:
        A table with the columns ``stamp_ns``, ``parent``, ``child``, ``x`` ... ``qw``, ``static`` and ``topic``.

    Raises:
        RecordingError: The package is not installed.
        ValueError: The format is unknown.
    """
    if format_ not in _FORMATS:
        raise ValueError(f"No format named {format_!r}. Known formats: {', '.join(_FORMATS)}.")
    package, install = _PACKAGES[format_]
    try:
        module = importlib.import_module(package)
    except ModuleNotFoundError:
        raise RecordingError(f"the table needs the package {package}, which is not installed", hint=install) from None
    return _FORMATS[format_](module, _columns([buffer.snapshot() for buffer in buffers]))


def _columns(buffers: list[Buffer]) -> _Columns:
    edges = [(buffer, edge) for buffer in buffers for edge in buffer.edges() if edge.samples]
    rows = sum(edge.samples for _, edge in edges)
    columns = _Columns(
        np.empty(rows, dtype=np.int64),
        _NameColumn(rows),
        _NameColumn(rows),
        np.empty((len(POSE_COLUMNS), rows)),
        np.empty(rows, dtype=np.bool_),
        _NameColumn(rows),
    )
    start = 0
    for buffer, edge in edges:
        _fill(columns, slice(start, start + edge.samples), buffer, edge)
        start += edge.samples
    return columns


def _fill(columns: _Columns, rows: slice, buffer: Buffer, edge: EdgeInfo) -> None:
    stamps, poses, parents, names = _core.samples_of(buffer, edge.child)
    codes = np.array([columns.parent.code(name) for name in names], dtype=np.int32)
    columns.stamps[rows] = np.frombuffer(stamps, dtype=np.int64)
    columns.parent.codes[rows] = codes[np.frombuffer(parents, dtype=np.uint32)]
    columns.child.codes[rows] = columns.child.code(edge.child)
    columns.poses[:, rows] = np.frombuffer(poses).reshape(-1, len(POSE_COLUMNS)).T
    columns.static[rows] = edge.static
    columns.topic.codes[rows] = columns.topic.code(edge.authority)


def _arrow(pyarrow: Any, columns: _Columns) -> Any:
    return pyarrow.table(_named(columns, lambda names: pyarrow.DictionaryArray.from_arrays(names.codes, names.names)))


def _pandas(pandas: Any, columns: _Columns) -> Any:
    return pandas.DataFrame(_named(columns, lambda names: pandas.Categorical.from_codes(names.codes, names.names)))


def _named(columns: _Columns, names: Callable[[_NameColumn], Any]) -> dict[str, Any]:
    poses = dict(zip(POSE_COLUMNS, columns.poses, strict=True))
    return {
        "stamp_ns": columns.stamps,
        "parent": names(columns.parent),
        "child": names(columns.child),
        **poses,
        "static": columns.static,
        "topic": names(columns.topic),
    }


_FORMATS = {"arrow": _arrow, "pandas": _pandas}
_PACKAGES = {"arrow": ("pyarrow", pip_install("parquet")), "pandas": ("pandas", "pip install pandas")}
