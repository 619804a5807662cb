# SPDX-License-Identifier: Apache-2.0
"""The results of a query on each recording, and the list of missing values."""

from __future__ import annotations

import json
import time
from dataclasses import asdict
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np

from coframe._files.complete_files import write_complete

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from coframe.bags._trajectory_query import TrajectoryQuery
    from coframe.bags.tables import TableQuery

__all__ = ["MANIFEST", "MAX_OMISSIONS", "Manifest", "Omission", "QueryResult", "omissions_of", "query_as_dict"]

MANIFEST: Final = "_manifest.json"  # dataset readers ignore names that begin with an underscore
MAX_OMISSIONS: Final = 100  # intervals without a value that are listed, for each column
_PERIOD: Final = 2.0  # seconds between two writes of the manifest


class Omission(NamedTuple):
    """An interval in which a recording has no value for the rows.

    Attributes:
        column: The column, or the frames of the poses, such as ``map:camera``.
        reason: Why there is no value.
        rows: The number of rows in a row.
        start: The time of the first one, in nanoseconds.
        stop: The time of the last one, in nanoseconds.
    """

    column: str
    reason: str
    rows: int
    start: int
    stop: int


class QueryResult(NamedTuple):
    """The result of a query for one recording.

    Attributes:
        bag: Path or URL of the recording, without passwords and signatures.
        poses: Number of poses, or rows of the table, that were written.
        missing: Number of poses or rows omitted because a value is missing.
        problems: Read errors and unusual data, one message each.
        error: Why the query failed, or "" if it succeeded.
        kept: Whether the file from an earlier run was kept.
        reason: For a failed query, a word that programs can compare: ``unreadable``, ``no topic``, ``no transform``,
            ``gap``, ``interrupted`` or ``failed``, or "" if it succeeded.
        omitted: The intervals without values, at most 100 for each column.
        file: The name of the file in the dataset; "" if there is none. For a failed query, it is that of an earlier run
            of the same query.
    """

    bag: str
    poses: int = 0
    missing: int = 0
    problems: tuple[str, ...] = ()
    error: str = ""
    kept: bool = False
    reason: str = ""
    omitted: tuple[Omission, ...] = ()
    file: str = ""


def omissions_of(column: str, reason: str, missing: NDArray[np.bool_], stamps: NDArray[np.int64]) -> list[Omission]:
    """Return the intervals of successive rows without a value.

    Args:
        column: The name of the column.
        reason: Why there is no value.
        missing: Whether each row has none, (N,).
        stamps: The times of the rows, (N,) nanoseconds.
    """
    edges = np.flatnonzero(np.diff(missing.astype(np.int8), prepend=0, append=0))
    pairs = edges.reshape(-1, 2)[:MAX_OMISSIONS]
    return [
        Omission(column, reason, int(end - start), int(stamps[start]), int(stamps[end - 1])) for start, end in pairs
    ]


def query_as_dict(query: TrajectoryQuery | TableQuery) -> dict[str, Any]:
    """Return a query as values that JSON has."""
    values: dict[str, Any] = json.loads(json.dumps(asdict(query), default=str))
    return {"kind": type(query).__name__, **values}


class Manifest:
    """The list of all recordings of a batch in its folder: what was written, what was omitted, and why.

    Args:
        folder: The folder of the dataset.
        query: The query.
        bags: The names of the recordings.
    """

    def __init__(self, folder: Path, query: TrajectoryQuery | TableQuery, bags: Sequence[str]) -> None:
        self._path = folder / MANIFEST
        self._query = query_as_dict(query)
        unfinished = "It was not read, because the batch was interrupted."
        self._results = [QueryResult(bag, error=unfinished, reason="interrupted") for bag in bags]
        self._written_at = -_PERIOD

    def add(self, number: int, result: QueryResult) -> None:
        """Store the result of a recording. The file is written periodically."""
        self._results[number] = result
        if time.monotonic() - self._written_at > _PERIOD:
            self.write()

    def write(self) -> None:
        """Write the file.

        Raises:
            OSError: It cannot be written.
        """
        recordings = [{**each._asdict(), "omitted": [one._asdict() for one in each.omitted]} for each in self._results]
        content = {"query": self._query, "recordings": [_renamed_values(each) for each in recordings]}
        write_complete(self._path, json.dumps(content, indent=1).encode())
        self._written_at = time.monotonic()


def _renamed_values(values: dict[str, Any]) -> dict[str, Any]:
    """Return the values of a result with the number of rows first and under its own name."""
    return {"bag": values.pop("bag"), "file": values.pop("file"), "rows": values.pop("poses"), **values}
