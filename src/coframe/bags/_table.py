# SPDX-License-Identifier: Apache-2.0
"""All transforms of a recording as one table, for pyarrow and pandas."""

from __future__ import annotations

import importlib
import warnings
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe import _core
from coframe._base_error import CoframeWarning
from coframe._output.formatting import count, duration
from coframe._process.optional_imports import pip_install
from coframe.buffer.gaps import gap_limit, gaps_between
from coframe.errors import ExtrapolationException, RecordingError
from coframe.trajectories.formats import POSE_COLUMNS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from coframe.buffer import Buffer, EdgeInfo
    from coframe.buffer.gaps import OnGap
    from coframe.time import DurationLike

__all__ = ["edge_table"]


class _NameColumn:
    """A dictionary-encoded column of names: one code per row, and the name for each code."""

    def __init__(self, rows: int) -> None:
        self.codes = np.empty(rows, dtype=np.int32)
        self._numbers: dict[str, int] = {}

    def code(self, name: str) -> int:
        """Return the code of a name, and assign a new one if needed."""
        return self._numbers.setdefault(name, len(self._numbers))

    @property
    def names(self) -> list[str]:
        """The names in the order of their codes."""
        return list(self._numbers)


class _Columns(NamedTuple):
    """The columns of the table, ordered by edge."""

    stamps: NDArray[np.int64]
    parent: _NameColumn
    child: _NameColumn
    poses: NDArray[np.float64]  # (7, N)
    static: NDArray[np.bool_]
    topic: _NameColumn
    gaps: NDArray[np.int64]


class _Samples(NamedTuple):
    """The samples of one edge, and the rows of NaN in its gaps."""

    edge: EdgeInfo
    buffer: Buffer
    rows: int


class _Gap(NamedTuple):
    """An interval without samples of an edge."""

    length: int
    parent: str
    child: str
    start: int


def edge_table(
    buffers: Iterable[Buffer],
    format_: str = "arrow",
    *,
    max_gap: DurationLike | None = None,
    on_gap: OnGap = "raise",
    validity: bool = False,
) -> Any:
    """Return every sample of every edge as a table.

    Args:
        buffers: The buffers that contain the samples.
        format_: ``"arrow"`` for a ``pyarrow.Table``, ``"pandas"`` for a ``DataFrame``.
        max_gap: The longest permitted interval between two samples of an edge; None warns of unusually long ones.
        on_gap: ``"raise"`` an exception for a longer one, mark it by a row of ``"nan"``, or ``"omit"`` such rows.
        validity: Whether to add the column ``gap_ns``.

    Returns:
        A table with the columns ``stamp_ns``, ``parent``, ``child``, ``x`` ... ``qw``, ``static`` and ``topic``.

    Raises:
        RecordingError: The package is not installed.
        ExtrapolationException: There is a longer gap.
        ValueError: The format or ``on_gap`` is unknown, or ``max_gap`` is not positive.
    """
    if format_ not in _FORMATS:
        raise ValueError(
            f"No format named {format_!r}. Known formats: {', '.join(_FORMATS)}. "
            "Columns are topics with fields, such as '/odom.pose', and poses, such as ('map', 'camera')."
        )
    limit = gap_limit(max_gap, on_gap)
    package, install = _PACKAGES[format_]
    try:
        module = importlib.import_module(package)
    except ModuleNotFoundError:
        raise RecordingError(f"the table needs the package {package}, which is not installed", hint=install) from None
    columns, gaps = _columns([buffer.snapshot() for buffer in buffers], limit, on_gap)
    if gaps and limit is None:
        edges, longest = len({(gap.parent, gap.child) for gap in gaps}), max(gaps)
        text = f"{longest.parent} -> {longest.child} for {duration(longest.length)} from {longest.start} ns on"
        warnings.warn(
            f"{count(edges, 'edge')} of the table {'has' if edges == 1 else 'have'} unusually long gaps without a "
            f'sample, such as {text}; on_gap="nan" marks them',
            CoframeWarning,
            stacklevel=3,
        )
    named = _FORMATS[format_]
    return named(module, columns, validity)


def _columns(buffers: list[Buffer], limit: int | None, on_gap: OnGap) -> tuple[_Columns, list[_Gap]]:
    """Return the columns and the gaps that are too long."""
    gaps: list[_Gap] = []
    edges = []
    for buffer in buffers:
        for edge in buffer.edges():
            if edge.samples:
                found = _gaps(buffer, edge, limit)
                gaps += found
                added = len(found) if limit is not None and on_gap == "nan" else 0
                edges.append(_Samples(edge, buffer, edge.samples + added))
    if gaps and limit is not None and on_gap == "raise":
        raise _gap_error(min(gaps, key=lambda gap: gap.start), limit, len(gaps))
    rows = sum(samples.rows for samples in edges)
    columns = _Columns(
        np.empty(rows, dtype=np.int64),
        _NameColumn(rows),
        _NameColumn(rows),
        np.empty((len(POSE_COLUMNS), rows)),
        np.empty(rows, dtype=np.bool_),
        _NameColumn(rows),
        np.zeros(rows, dtype=np.int64),
    )
    start = 0
    for samples in edges:
        _fill(columns, slice(start, start + samples.rows), samples, limit)
        start += samples.rows
    return columns, gaps


def _gaps(buffer: Buffer, edge: EdgeInfo, limit: int | None) -> list[_Gap]:
    if edge.static:
        return []
    stamps = np.frombuffer(_core.samples_of(buffer, edge.child)[0], dtype=np.int64)
    after = gaps_between(stamps, limit)
    return [_Gap(int(stamps[i + 1] - stamps[i]), edge.parent, edge.child, int(stamps[i])) for i in after]


def _gap_error(gap: _Gap, limit: int, gaps: int) -> ExtrapolationException:
    others = f" (one of {count(gaps, 'such gap')})" if gaps > 1 else ""
    return ExtrapolationException.with_details(
        f"{gap.parent} -> {gap.child} has no sample for {duration(gap.length)} after {gap.start} ns{others}, which is "
        f"longer than max_gap, {duration(limit)}",
        target=gap.parent,
        source=gap.child,
        requested=gap.start,
        hint='on_gap="nan" marks each gap by a row of NaN; on_gap="omit" returns the samples only.',
    )


def _fill(columns: _Columns, rows: slice, samples: _Samples, limit: int | None) -> None:
    edge = samples.edge
    found, poses, parents, names = _core.samples_of(samples.buffer, edge.child)
    stamps = np.frombuffer(found, dtype=np.int64)
    values = np.frombuffer(poses).reshape(-1, len(POSE_COLUMNS))
    codes = np.array([columns.parent.code(name) for name in names], dtype=np.int32)[np.frombuffer(parents, np.uint32)]
    gaps = np.diff(stamps, prepend=stamps[:1])
    if samples.rows > edge.samples:
        after = gaps_between(stamps, limit)
        middles = stamps[after] + (stamps[after + 1] - stamps[after]) // 2
        values = np.insert(values, after + 1, np.nan, axis=0)
        codes = np.insert(codes, after + 1, codes[after])
        gaps = np.insert(gaps, after + 1, gaps[after + 1])
        stamps = np.insert(stamps, after + 1, middles)
    columns.stamps[rows] = stamps
    columns.parent.codes[rows] = codes
    columns.child.codes[rows] = columns.child.code(edge.child)
    columns.poses[:, rows] = values.T
    columns.static[rows] = edge.static
    columns.topic.codes[rows] = columns.topic.code(edge.authority)
    if not edge.static:
        columns.gaps[rows] = gaps


def _to_arrow(pyarrow: Any, columns: _Columns, validity: bool) -> Any:
    array = pyarrow.DictionaryArray.from_arrays
    return pyarrow.table(_named_columns(columns, validity, lambda names: array(names.codes, names.names)))


def _to_pandas(pandas: Any, columns: _Columns, validity: bool) -> Any:
    array = pandas.Categorical.from_codes
    return pandas.DataFrame(_named_columns(columns, validity, lambda names: array(names.codes, names.names)))


def _named_columns(columns: _Columns, validity: bool, names: Callable[[_NameColumn], Any]) -> dict[str, Any]:
    poses = dict(zip(POSE_COLUMNS, columns.poses, strict=True))
    return {
        "stamp_ns": columns.stamps,
        "parent": names(columns.parent),
        "child": names(columns.child),
        **poses,
        "static": columns.static,
        "topic": names(columns.topic),
        **({"gap_ns": columns.gaps} if validity else {}),
    }


_FORMATS = {"arrow": _to_arrow, "pandas": _to_pandas}
_PACKAGES = {"arrow": ("pyarrow", pip_install("parquet")), "pandas": ("pandas", "pip install pandas")}
