# SPDX-License-Identifier: Apache-2.0
"""Run a query on many recordings in parallel; the results form one Parquet dataset.

:func:`query_recording` does the work for one recording. Its arguments and result can be pickled, so that it runs in
local processes, on Dask, on Ray or on any other engine.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe._process.optional_imports import pip_install
from coframe._sources.remote_error import RemoteFileError
from coframe._sources.sources import as_source
from coframe.bags._batch_engines import ENGINES, optional_module
from coframe.bags._batch_parts import fingerprint, keep_if_of_query, part_of, previous_result, write_part
from coframe.bags._batch_results import MANIFEST, MAX_OMISSIONS, Manifest, Omission, QueryResult, omissions_of
from coframe.bags._narrowing import run_query
from coframe.bags.recording import open_with_choice
from coframe.bags.tables import TableQuery
from coframe.bags.tables.columns import FieldSource, column, column_list
from coframe.errors import CoframeError, ExtrapolationException, RecordingError, TransformException
from coframe.trajectories.formats import POSE_COLUMNS

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterator, Sequence

    from coframe._sources.sources import Location, Readable
    from coframe.bags._trajectory_query import TrajectoryQuery
    from coframe.bags.recording import Recording
    from coframe.bags.tables import Table

__all__ = ["ENGINES", "MANIFEST", "Omission", "QueryResult", "query_recording", "query_recordings"]


class _FailedError(Exception):
    """A recording that is not part of the dataset.

    Attributes:
        reason: The word for it in :class:`QueryResult`.
        error: What is wrong.
    """

    def __init__(self, reason: str, error: Exception) -> None:
        super().__init__(reason, error)
        self.reason = reason
        self.error = error


def query_recording(bag: Location, query: TrajectoryQuery | TableQuery, folder: str | os.PathLike[str]) -> QueryResult:
    """Run a query on one recording and write its file in the dataset; never raises.

    An existing file is kept if it was written for the same query, the recording has not changed since, and the file
    has its checksum.

    Args:
        bag: Path or URL of the recording.
        query: The poses or the table to write.
        folder: Folder of the dataset, which must exist.

    Returns:
        The result. The file has the column ``bag`` and, for poses, ``stamp_ns``, ``x`` ... ``qw``, and those of the
        query's validity; for tables, those of :meth:`Table.to_arrow` with ``flat=True``.
    """
    try:
        path = as_source(bag)
    except RemoteFileError as error:
        return QueryResult(str(error.filename), error=_sentences(error), reason="unreadable")
    part = part_of(path, Path(folder))
    try:
        return _query(path, query, part)
    except _FailedError as failed:
        reason, problem = failed.reason, failed.error
    except Exception as error:  # noqa: BLE001 - one recording must never stop the others
        reason, problem = "failed", error
    there = part.name if keep_if_of_query(part, query) else ""
    return QueryResult(str(path), error=_sentences(problem), reason=reason, file=there)


def query_recordings(
    bags: Sequence[Location],
    query: TrajectoryQuery | TableQuery,
    folder: str | os.PathLike[str],
    *,
    on: str = "processes",
    workers: int | None = None,
    progress: Callable[[QueryResult], object] = lambda _result: None,
) -> list[QueryResult]:
    """Run the same query on many recordings in parallel, and keep the files of earlier runs.

    The file ``_manifest.json`` in the folder lists all recordings: the file and the rows of each, the intervals without
    values, and why a recording is missing. It is also written if the batch is interrupted.

    Args:
        bags: Paths or URLs of the recordings. Duplicates are skipped.
        query: The poses to look up in each recording, or the table to write.
        folder: Folder of the dataset: one Parquet file per recording, which pyarrow
            (``pyarrow.dataset.dataset(folder)``), pandas, Dask and DuckDB read as one table.
        on: The engine: ``"processes"`` on this machine, ``"dask"`` or ``"ray"``. Dask uses the cluster of
        ``DASK_SCHEDULER_ADDRESS`` or of its configuration, and Ray uses the cluster of ``RAY_ADDRESS``; without these,
        they start workers on this machine. The workers must have coframe and the same paths.
        workers: Number of workers; by default one per processor, with Dask and Ray their own default.
        progress: Called with each result as soon as it is available.

    Returns:
        The results in the order of the recordings, failed ones included (see :attr:`QueryResult.error`).

    Raises:
        RecordingError: pyarrow, Dask or Ray is not installed, the folder cannot be written, or a URL is not valid.
        ValueError: ``on`` is not one of these names.
    """
    if on not in ENGINES:
        raise ValueError(f"No engine named {on!r}. Known engines: {', '.join(ENGINES)}.")
    _pyarrow()
    target = Path(folder).absolute()
    paths = list(dict.fromkeys(map(_absolute, bags)))
    manifest = Manifest(target, query, [str(path) for path in paths])
    try:
        target.mkdir(parents=True, exist_ok=True)
        manifest.write()
    except OSError as error:
        raise RecordingError(
            f"cannot create the folder {target}: {error.strerror or error}", hint="Choose another folder."
        ) from None
    jobs: list[Any] = [(path, query, str(target)) for path in paths]
    numbers = {id(job): number for number, job in enumerate(jobs)}
    results: dict[int, QueryResult] = {}
    try:
        for job, result in ENGINES[on](query_recording, jobs, workers):
            number = numbers[id(job)]
            results[number] = result
            manifest.add(number, result)
            progress(result)
    finally:
        manifest.write()
    return [results[number] for number in range(len(jobs))]


def _absolute(bag: Location) -> Readable:
    try:
        path = as_source(bag)
    except RemoteFileError as error:
        raise RecordingError(str(error), hint=error.hint) from None
    return path.absolute() if isinstance(path, Path) else path


def _sentences(error: Exception) -> str:
    parts = (str(error) or type(error).__name__, getattr(error, "hint", ""))
    sentences = [" ".join(part.split()) for part in parts if part]
    return " ".join(part if part.endswith((".", "?")) else f"{part}." for part in sentences)


def _query(bag: Readable, query: TrajectoryQuery | TableQuery, part: Path) -> QueryResult:
    try:
        made_from = fingerprint(bag, query)
    except OSError as error:
        if isinstance(error, CoframeError):
            raise _FailedError("unreadable", error) from None
        made_from = b""  # Opening it describes what is wrong.
    if made_from and (kept := previous_result(part, str(bag), made_from)) is not None:
        return kept
    try:
        recording = open_with_choice(bag, query.transforms)
    except CoframeError as error:
        raise _FailedError("unreadable", error) from None
    with recording:
        run = _TableRun(recording, query) if isinstance(query, TableQuery) else _TrajectoryRun(recording, query)
        try:
            return write_part(part, run.tables(), run.result, made_from)
        except (CoframeError, ValueError) as error:
            raise _FailedError(_reason(error, recording, query), error) from error


def _reason(error: Exception, recording: Recording, query: TrajectoryQuery | TableQuery) -> str:
    """Return the word for an error of a query; see :class:`QueryResult`."""
    existing = {topic.removeprefix("/") for topic in recording.topics}
    if any(topic.removeprefix("/") not in existing for topic in _topics(query)):
        return "no topic"
    if isinstance(error, ExtrapolationException):
        return "gap"
    return "no transform" if isinstance(error, TransformException) else "failed"


def _topics(query: TrajectoryQuery | TableQuery) -> list[str]:
    """Return the topics that a query needs."""
    if not isinstance(query, TableQuery):
        return [] if query.stamps_of is None else [query.stamps_of]
    columns = map(column, column_list(query.columns))
    topics = [each.parsed.topic for each in columns if isinstance(each.parsed, FieldSource)]
    return topics if query.at is None else [*topics, query.at]


class _TrajectoryRun:
    """The poses of a recording as tables."""

    def __init__(self, recording: Recording, query: TrajectoryQuery) -> None:
        self._recording = recording
        self._query = query
        self._missing_count = 0
        self._omissions: list[Omission] = []
        self._gaps = ""

    def tables(self) -> Iterator[Any]:
        """Yield the poses as one table."""
        pyarrow = _pyarrow()
        requested_stamps = self._query.stamps(self._recording)
        poses, self._missing_count = self._query.run(self._recording)
        stamps = np.zeros(1, dtype=np.int64) if poses.stamps is None else np.atleast_1d(poses.stamps)
        name = f"{self._query.target}:{self._query.source}"
        self._omissions = omissions_of(name, "no transform", ~np.isin(requested_stamps, stamps), requested_stamps)
        self._gaps = self._query.gap_text(self._recording, requested_stamps)
        values = np.concatenate([np.atleast_2d(poses.translation), np.atleast_2d(poses.quaternion)], axis=1)
        columns = {"bag": _bag_column(pyarrow, self._recording, len(values)), "stamp_ns": stamps}
        columns |= dict(zip(POSE_COLUMNS, values.T.copy(), strict=True))
        columns |= self._query.validity_of(self._recording, poses) if self._query.validity else {}
        yield pyarrow.table(columns)

    def result(self) -> QueryResult:
        """Return the result."""
        problems = [*self._recording.problems, self._gaps] if self._gaps else self._recording.problems
        return QueryResult(
            str(self._recording.path),
            missing=self._missing_count,
            problems=tuple(problems),
            omitted=tuple(self._omissions),
        )


class _TableRun:
    """The rows of a table of a recording, in parts."""

    def __init__(self, recording: Recording, query: TableQuery) -> None:
        self._recording = recording
        self._query = query
        self._missing_count = 0
        self._omissions: dict[str, list[Omission]] = {}
        self._sentences: list[str] = []

    def tables(self) -> Iterator[Any]:
        """Yield the rows."""
        pyarrow = _pyarrow()
        omits = self._query.on_gap == "omit"
        query = replace(self._query, on_gap="nan") if omits else self._query
        for table in self._parts(query):
            self._add_notes(table)
            complete = np.logical_and.reduce([each.valid for each in table.columns])
            rows = table.taken(complete) if omits else table
            self._missing_count += len(table) - len(rows)
            flat_table = rows.to_arrow(flat=True)
            yield flat_table.add_column(0, "bag", _bag_column(pyarrow, self._recording, len(rows)))

    def _parts(self, query: TableQuery) -> Iterator[Table]:
        if self._recording.is_waiting and not (query.start is None and query.stop is None):
            yield run_query(self._recording, query, None, self._sentences.append)
        else:
            yield from query.batches(self._recording, report=self._sentences.append)

    def _add_notes(self, table: Table) -> None:
        for each in table.columns:
            reason = "no message within the limits" if each.gap is None else "no samples around it within the limits"
            new = omissions_of(each.name, reason, ~each.valid, table.stamps)
            self._omissions[each.name] = [*self._omissions.get(each.name, ()), *new][:MAX_OMISSIONS]

    def result(self) -> QueryResult:
        """Return the result."""
        omitted = tuple(each for found in self._omissions.values() for each in found)
        problems = (*self._recording.problems, *self._sentences)
        return QueryResult(str(self._recording.path), missing=self._missing_count, problems=problems, omitted=omitted)


def _pyarrow() -> Any:
    return optional_module("pyarrow", "Parquet", pip_install("parquet"))


def _bag_column(pyarrow: Any, recording: Recording, rows: int) -> Any:
    return pyarrow.array([str(recording.path)] * rows, pyarrow.string()).dictionary_encode()
