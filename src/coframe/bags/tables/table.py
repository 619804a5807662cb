# SPDX-License-Identifier: Apache-2.0
"""Table: values at many times, for Arrow, pandas, polars, xarray, NumPy and files."""

from __future__ import annotations

import importlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe._output import html_tables
from coframe._output.formatting import count, did_you_mean, join_names
from coframe._process.optional_imports import pip_install
from coframe.bags.tables._arrow import arrow_array, arrow_struct
from coframe.bags.tables._leaves import Leaf
from coframe.errors import RecordingError

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator

    from numpy.typing import NDArray

__all__ = ["MAX_EXPANDED", "Table", "TableColumn", "TableValue"]

MAX_EXPANDED = 64  # elements of an array that become columns of a data frame
_SHOWN_ROWS = 10
_PACKAGES = {
    "pyarrow": pip_install("parquet"),
    "pandas": "pip install pandas",
    "polars": "pip install polars",
    "xarray": "pip install xarray",
}


@dataclass(frozen=True, eq=False)
class TableValue:
    """One value of a column in all rows.

    Attributes:
        leaf: What it is.
        array: (N,), or (N, K) for an array of K numbers. Floats that are missing are NaN; other numbers are 0.
        known: Whether each row has the value, (N,).
    """

    leaf: Leaf
    array: NDArray[Any]
    known: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class TableColumn:
    """A column as it was requested, with its values.

    Attributes:
        name: The name of the column.
        values: Its values: one, or one for each field of a message.
        valid: Whether a row has a value within the limits, (N,).
        age: The time of the row minus the stamp of its message in nanoseconds, (N,), or None for interpolated values.
        gap: The interval that was interpolated over in nanoseconds, (N,), or None for values that are not interpolated.
    """

    name: str
    values: list[TableValue]
    valid: NDArray[np.bool_]
    age: NDArray[np.int64] | None = None
    gap: NDArray[np.int64] | None = None

    def taken(self, rows: Any) -> TableColumn:
        """Return the column with some of its rows."""
        return TableColumn(
            self.name,
            [TableValue(each.leaf, each.array[rows], each.known[rows]) for each in self.values],
            self.valid[rows],
            None if self.age is None else self.age[rows],
            None if self.gap is None else self.gap[rows],
        )


@dataclass(frozen=True, eq=False)
class Table:
    """The values of fields and poses at many times, as returned by :meth:`coframe.bags.Recording.table`.

    The names of values are those of expressions: ``/odom.pose.pose.position.x``, ``map:camera.qw``. Each column has
    the values ``.valid``, and ``.age_ns`` or ``.gap_ns``, unless the table was requested without them.

    Attributes:
        stamps: The times of the rows, (N,) nanoseconds.
        columns: The columns as they were requested.
        has_validity: Whether the table contains the validity of its columns.
        omitted: Number of rows left out because a value is missing, with ``on_gap="omit"``.
    """

    stamps: NDArray[np.int64]
    columns: list[TableColumn]
    has_validity: bool = True
    omitted: int = 0
    _arrays: dict[str, TableValue] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        for name, value in self._named_values():
            if name in self._arrays or name == "stamp_ns":
                raise RecordingError(
                    f"two columns of the table are named {name!r}",
                    hint='Give one of them a name: Column(source, name="other"), or "other=SOURCE".',
                )
            self._arrays[name] = value

    def __len__(self) -> int:
        return len(self.stamps)

    @property
    def names(self) -> list[str]:
        """The names of all values, without ``stamp_ns``."""
        return list(self._arrays)

    def __contains__(self, name: object) -> bool:
        return name in self._arrays

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return the array of a value.

        Raises:
            KeyError: No value has this name.
        """
        if name == "stamp_ns":
            return self.stamps
        if name not in self._arrays:
            inside = [each for each in self._arrays if each.startswith((f"{name}.", f"{name}["))]
            meant = f"Its values: {join_names(inside)}." if inside else did_you_mean(name, self._arrays)
            raise KeyError(f"the table has no value named {name!r}. {meant}".strip())
        return self._arrays[name].array

    def to_numpy(self) -> dict[str, NDArray[Any]]:
        """Return the arrays by name, with ``stamp_ns`` first.

        Missing floats are NaN; other numbers with missing values are masked arrays.
        """
        return {"stamp_ns": self.stamps, **{name: _masked_array(value) for name, value in self._arrays.items()}}

    def to_arrow(self, *, flat: bool = False) -> Any:
        """Return a ``pyarrow.Table``, in which missing values are null.

        Args:
            flat: Whether each value is a column. By default, each requested column is one, and messages and poses are
                structs.

        Raises:
            RecordingError: pyarrow is not installed.
        """
        pyarrow = _module("pyarrow")
        columns = {"stamp_ns": pyarrow.array(self.stamps)}
        if flat:
            for name, value in self._arrays.items():
                columns[name] = arrow_array(pyarrow, value.leaf, value.array, value.known)
            return pyarrow.table(columns)
        for column in self.columns:
            columns[column.name] = arrow_struct(
                pyarrow, [(each.leaf, each.array, each.known) for each in column.values], column.valid
            )
            for name, value in self._validity(column):
                columns[name] = arrow_array(pyarrow, value.leaf, value.array, value.known)
        return pyarrow.table(columns)

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        return self.to_arrow(flat=True).__arrow_c_stream__(requested_schema)

    def to_pandas(self) -> Any:
        """Return a ``pandas.DataFrame`` with a column for each value; those of arrays are named ``[0]``, ``[1]``, ...

        Arrays of more than 64 numbers and sequences are objects.

        Raises:
            RecordingError: pandas is not installed.
        """
        pandas = _module("pandas")
        columns = {"stamp_ns": self.stamps}
        for name, leaf, array, known in self.expanded():
            if array.dtype.kind in "iub" and not known.all():
                nullable = pandas.array(array, dtype="boolean" if leaf.kind == "boolean" else _capitalize(array.dtype))
                nullable[~known] = pandas.NA
                columns[name] = nullable
            else:
                columns[name] = array
        return pandas.DataFrame(columns)

    def to_polars(self) -> Any:
        """Return a ``polars.DataFrame`` with a column for each value.

        Raises:
            RecordingError: polars or pyarrow is not installed.
        """
        return _module("polars").from_arrow(self.to_arrow(flat=True))

    def to_xarray(self) -> Any:
        """Return an ``xarray.Dataset`` with a variable for each value over the coordinate ``stamp`` (datetime64).

        Raises:
            RecordingError: xarray is not installed.
        """
        variables = {}
        for name, value in self._arrays.items():
            array = value.array
            if array.dtype.kind in "iu" and not value.known.all():
                array = np.where(value.known if array.ndim == 1 else value.known[:, None], array, np.nan)
            variables[name] = (("stamp",) if array.ndim == 1 else ("stamp", f"{name}.axis"), array)
        return _module("xarray").Dataset(variables, coords={"stamp": self.stamps.astype("datetime64[ns]")})

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the table to a file with a column for each value.

        Args:
            path: Its suffix selects the format: ``.parquet``, ``.arrow`` or ``.feather``, ``.csv``, ``.npz``.

        Raises:
            RecordingError: The format is unknown or cannot store the columns, or pyarrow is not installed.
            OSError: The file cannot be written.
        """
        from coframe.bags.tables.files import write_table  # noqa: PLC0415 - it imports this module

        write_table(self, path)

    def expanded(self) -> Iterator[tuple[str, Leaf, NDArray[Any], NDArray[np.bool_]]]:
        """Yield the name, description, array and known rows of each value. Short arrays are split into elements."""
        for name, value in self._arrays.items():
            if value.array.ndim == 2 and value.leaf.size <= MAX_EXPANDED:
                for index in range(value.leaf.size):
                    yield f"{name}[{index}]", value.leaf, value.array[:, index], value.known
            elif value.array.ndim == 2:
                rows = np.empty(len(self), dtype=object)
                for row in np.flatnonzero(value.known):
                    rows[row] = value.array[row]
                yield name, value.leaf, rows, value.known
            else:
                yield name, value.leaf, value.array, value.known

    def taken(self, rows: Any) -> Table:
        """Return the table with some of its rows.

        Args:
            rows: Indices, a slice or a mask.
        """
        return Table(self.stamps[rows], [each.taken(rows) for each in self.columns], self.has_validity, self.omitted)

    @classmethod
    def joined(cls, parts: list[Table]) -> Table:
        """Return one table with the rows of several tables with the same columns.

        Args:
            parts: At least one table.
        """
        if len(parts) == 1:
            return parts[0]
        columns = [_join_columns(list(columns)) for columns in zip(*(part.columns for part in parts), strict=True)]
        stamps = np.concatenate([part.stamps for part in parts])
        return cls(stamps, columns, parts[0].has_validity, sum(part.omitted for part in parts))

    def _named_values(self) -> Iterator[tuple[str, TableValue]]:
        for column in self.columns:
            for value in column.values:
                yield f"{column.name}{value.leaf.suffix}", value
            yield from self._validity(column)

    def _validity(self, column: TableColumn) -> Iterator[tuple[str, TableValue]]:
        if not self.has_validity:
            return
        every = np.ones(len(column.valid), dtype=bool)
        yield f"{column.name}.valid", TableValue(Leaf((), "boolean", np.dtype(bool)), column.valid, every)
        for suffix, array in (("age_ns", column.age), ("gap_ns", column.gap)):
            if array is not None:
                yield f"{column.name}.{suffix}", TableValue(Leaf((), "number", np.dtype("int64")), array, every)

    def __repr__(self) -> str:
        return f"Table({count(len(self), 'row')}, columns: {join_names(each.name for each in self.columns)})"

    def _repr_html_(self) -> str:
        shown = list(self.expanded())
        rows = (
            (str(self.stamps[row]), *(str(array[row]) if known[row] else "" for _, _, array, known in shown))
            for row in range(min(len(self), _SHOWN_ROWS))
        )
        names = ("stamp_ns", *(name for name, *_ in shown))
        return html_tables.section(repr(self), html_tables.table(names, rows, len(self), "row"))


def _join_columns(columns: list[TableColumn]) -> TableColumn:
    first = columns[0]
    values = [
        TableValue(
            first.values[index].leaf,
            np.concatenate([each.values[index].array for each in columns]),
            np.concatenate([each.values[index].known for each in columns]),
        )
        for index in range(len(first.values))
    ]
    ages, gaps = ([getattr(each, name) for each in columns] for name in ("age", "gap"))
    return TableColumn(
        first.name,
        values,
        np.concatenate([each.valid for each in columns]),
        None if first.age is None else np.concatenate(ages),
        None if first.gap is None else np.concatenate(gaps),
    )


def _masked_array(value: TableValue) -> NDArray[Any]:
    if value.array.dtype.kind in "iub" and not value.known.all():
        known = value.known if value.array.ndim == 1 else np.broadcast_to(value.known[:, None], value.array.shape)
        return np.ma.MaskedArray(value.array, mask=~known)
    return value.array


def _capitalize(dtype: np.dtype[Any]) -> str:
    """Return pandas's name of the integers that may be missing."""
    return f"{'UInt' if dtype.kind == 'u' else 'Int'}{8 * dtype.itemsize}"


def _module(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        raise RecordingError(
            f"the table needs the package {name}, which is not installed", hint=_PACKAGES[name]
        ) from None
