"""Every transform of a recording as one table, for the tools that work on tables."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe import _core
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from coframe.buffer import Buffer, EdgeInfo

__all__ = ["POSE_COLUMNS", "edge_table"]

POSE_COLUMNS = ("x", "y", "z", "qx", "qy", "qz", "qw")


class _Names:
    """A column of few different names: numbers, and what they stand for."""

    def __init__(self, rows: int) -> None:
        self.codes = np.empty(rows, dtype=np.int32)
        self._numbers: dict[str, int] = {}

    def code(self, name: str) -> int:
        """The number of a name, a new one if need be."""
        return self._numbers.setdefault(name, len(self._numbers))

    @property
    def names(self) -> list[str]:
        """By their numbers."""
        return list(self._numbers)


class _Columns(NamedTuple):
    """All samples, one edge after the other."""

    stamps: NDArray[np.int64]
    parent: _Names
    child: _Names
    poses: NDArray[np.float64]  # (7, N)
    static: NDArray[np.bool_]
    topic: _Names


def edge_table(buffers: Iterable[Buffer], format_: str = "arrow") -> Any:
    """Every sample of every edge: ``stamp_ns``, ``parent``, ``child``, x to qw, ``static``, ``topic``.

    Args:
        buffers: What to take them from.
        format_: ``"arrow"`` for a ``pyarrow.Table``, ``"pandas"`` for a ``DataFrame``.

    Raises:
        RecordingError: The package is not installed.
        ValueError: There is no such format.
    """
    if format_ not in _FORMATS:
        raise ValueError(f"there is no format {format_!r}: it is one of {', '.join(_FORMATS)}")
    package, extra = _PACKAGES[format_]
    try:
        module = importlib.import_module(package)
    except ModuleNotFoundError:
        raise RecordingError(f"this table needs the package {package}", hint=f"pip install {extra}") from None
    return _FORMATS[format_](module, _columns([buffer.snapshot() for buffer in buffers]))


def _columns(buffers: list[Buffer]) -> _Columns:
    edges = [(buffer, edge) for buffer in buffers for edge in buffer.edges() if edge.samples]
    rows = sum(edge.samples for _, edge in edges)
    columns = _Columns(
        np.empty(rows, dtype=np.int64),
        _Names(rows),
        _Names(rows),
        np.empty((len(POSE_COLUMNS), rows)),
        np.empty(rows, dtype=np.bool_),
        _Names(rows),
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
    return pyarrow.table(_named(columns, lambda of: pyarrow.DictionaryArray.from_arrays(of.codes, of.names)))


def _pandas(pandas: Any, columns: _Columns) -> Any:
    return pandas.DataFrame(_named(columns, lambda of: pandas.Categorical.from_codes(of.codes, of.names)))


def _named(columns: _Columns, names: Callable[[_Names], Any]) -> dict[str, Any]:
    poses = dict(zip(POSE_COLUMNS, columns.poses, strict=True))
    told = {"parent": names(columns.parent), "child": names(columns.child)}
    return {
        "stamp_ns": columns.stamps,
        **told,
        **poses,
        "static": columns.static,
        "topic": names(columns.topic),
    }


_FORMATS = {"arrow": _arrow, "pandas": _pandas}
_PACKAGES = {"arrow": ("pyarrow", "'coframe[parquet]'"), "pandas": ("pandas", "pandas")}
