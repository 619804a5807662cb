# SPDX-License-Identifier: Apache-2.0
"""Run a trajectory query on many recordings in parallel; the results form one Parquet dataset.

:func:`query_recording` does the work for one recording. Its arguments and result can be pickled, so that it runs in
local processes, on Dask, on Ray or on any other engine.
"""

from __future__ import annotations

import hashlib
import importlib
import json
import os
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe._files.complete_files import write_complete
from coframe._files.regular_files import open_regular, read_regular
from coframe._process.optional_imports import pip_install
from coframe._sources.sources import Source, as_source
from coframe.bags._batch_processes import run_jobs
from coframe.bags.recording import open_chosen
from coframe.errors import RecordingError
from coframe.trajectories.formats import POSE_COLUMNS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from coframe._sources.sources import Location
    from coframe.bags._trajectory_query import TrajectoryQuery
    from coframe.transform.transform import Transform

__all__ = ["ENGINES", "QueryResult", "query_recording", "query_recordings"]

_METADATA_KEY = b"coframe"
_CHECKSUM_DIGITS = 64  # of SHA-256
_MAX_CHECKSUM_FILE = 10_000  # bytes: the digest and the file name
_REPORT_KEY = b"coframe.report"  # keys of the number of missing poses and the problems


class QueryResult(NamedTuple):
    """The result of a query for one recording.

    Attributes:
        bag: Path of the recording.
        poses: Number of poses written.
        missing: Number of stamps omitted because there is no transform.
        problems: Read errors and unusual data, one message each.
        error: Why the query failed; "" if it succeeded.
        kept: Whether the file from an earlier run was kept.
    """

    bag: str
    poses: int = 0
    missing: int = 0
    problems: tuple[str, ...] = ()
    error: str = ""
    kept: bool = False


def query_recording(bag: str, query: TrajectoryQuery, folder: str) -> QueryResult:
    """Run a query on one recording and write its file in the dataset; never raises.

    An existing file is kept if it was written for the same query, the recording has not changed since, and the file
    has its checksum.

    Args:
        bag: Path of the recording.
        query: The frames and times of the poses to look up.
        folder: Folder of the dataset, which must exist.

    Returns:
        The result. The file has the columns ``bag``, ``stamp_ns``, ``x`` ... ``qw``, and those of the query's validity.
    """
    try:
        return _query(bag, query, Path(folder))
    except Exception as error:  # noqa: BLE001 - one recording must never stop the others
        parts = (str(error) or type(error).__name__, getattr(error, "hint", ""))
        sentences = [" ".join(part.split()) for part in parts if part]
        return QueryResult(bag, error=" ".join(part if part.endswith((".", "?")) else f"{part}." for part in sentences))


def query_recordings(
    bags: Sequence[Location],
    query: TrajectoryQuery,
    folder: str | os.PathLike[str],
    *,
    on: str = "processes",
    workers: int | None = None,
    progress: Callable[[QueryResult], object] = lambda _result: None,
) -> list[QueryResult]:
    """Run the same query on many recordings in parallel, and keep the files of earlier runs.

    Args:
        bags: Paths of the recordings. Duplicates are skipped.
        query: The frames and times of the poses to look up in each recording.
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
        RecordingError: pyarrow, Dask or Ray is not installed, or the folder cannot be created.
        ValueError: ``on`` is not one of these names.
    """
    if on not in ENGINES:
        raise ValueError(f"No engine named {on!r}. Known engines: {', '.join(ENGINES)}.")
    _module("pyarrow", "Parquet", pip_install("parquet"))
    target = Path(folder).absolute()
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise RecordingError(
            f"cannot create the folder {target}: {error.strerror or error}", hint="Choose another folder."
        ) from None
    paths = list(dict.fromkeys(_path_of(bag) for bag in bags))
    results = {}
    for result in ENGINES[on]([(path, query, str(target)) for path in paths], workers):
        results[result.bag] = result
        progress(result)
    return [results[path] for path in paths]


def _path_of(bag: Location) -> str:
    path = as_source(bag)
    if isinstance(path, Source):
        raise RecordingError(f"{path} cannot be part of a batch", hint="Download it first.")
    return str(path.absolute())


def _query(bag: str, query: TrajectoryQuery, folder: Path) -> QueryResult:
    fingerprint = _fingerprint(bag, query)
    part = folder / f"{Path(bag).stem}-{hashlib.sha256(bag.encode()).hexdigest()[:12]}.parquet"
    if (kept := _previous_result(part, bag, fingerprint)) is not None:
        return kept
    with open_chosen(bag, query.transforms) as recording:
        found, missing = query.run(recording)
        stamps = np.zeros(0, np.int64) if found.stamps is None else np.atleast_1d(found.stamps)
        gaps = query.gap_text(recording, stamps)
        problems = (*recording.problems, gaps) if gaps else tuple(recording.problems)
        others = query.validity_of(recording, found) if query.validity else {}
    result = QueryResult(bag, len(found) if found.shape else 1, missing, problems)
    _write(part, found, others, result, fingerprint)
    return result


def _fingerprint(bag: str, query: TrajectoryQuery) -> bytes:
    """Return a fingerprint of the query and of the sizes and modification times of the recording's files."""
    path = Path(bag)
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    state = [(file.name, file.stat().st_size, file.stat().st_mtime_ns) for file in files if file.is_file()]
    return json.dumps({"query": asdict(query), "state": state}, sort_keys=True).encode()


def _previous_result(part: Path, bag: str, fingerprint: bytes) -> QueryResult | None:
    """Return the result of an earlier run; None if its file does not exist, is damaged or is out of date."""
    if not _is_intact(part):
        return None
    try:
        with open_regular(part) as file:
            metadata = importlib.import_module("pyarrow.parquet").read_metadata(file)
    except Exception:  # noqa: BLE001 - a damaged file is written again
        return None
    stored = metadata.metadata or {}
    if stored.get(_METADATA_KEY) != fingerprint or _REPORT_KEY not in stored:
        return None
    missing, problems = json.loads(stored[_REPORT_KEY])
    return QueryResult(bag, int(metadata.num_rows), missing, tuple(problems), kept=True)


def _write(
    part: Path, poses: Transform, others: dict[str, NDArray[np.int64]], result: QueryResult, fingerprint: bytes
) -> None:
    arrow: Any = importlib.import_module("pyarrow")
    parquet: Any = importlib.import_module("pyarrow.parquet")
    values = np.concatenate([np.atleast_2d(poses.translation), np.atleast_2d(poses.quaternion)], axis=1)
    stamps = np.zeros(1, dtype=np.int64) if poses.stamps is None else poses.stamps
    columns = {"bag": arrow.array([result.bag] * len(values)).dictionary_encode(), "stamp_ns": stamps}
    columns |= dict(zip(POSE_COLUMNS, values.T.copy(), strict=True)) | others
    temporary = part.with_name(f"_{part.name}.{os.getpid()}")  # dataset readers ignore names with this prefix
    try:
        metadata = {_METADATA_KEY: fingerprint, _REPORT_KEY: json.dumps([result.missing, result.problems])}
        parquet.write_table(arrow.table(columns).replace_schema_metadata(metadata), temporary)
        checksum = _checksum(temporary)
        temporary.replace(part)
        write_complete(_checksum_file(part), f"{checksum}  {part.name}\n".encode())
    except OSError as error:
        reason = os.strerror(error.errno) if error.errno else str(error)
        raise RecordingError(
            f"{part} cannot be written: {reason}", hint="Check the free space and the write permission."
        ) from None
    finally:
        with suppress(OSError):
            temporary.unlink()


def _is_intact(part: Path) -> bool:
    """Return whether a file matches its checksum. Without this check, a flipped bit would silently change a pose."""
    try:
        return read_regular(_checksum_file(part), _MAX_CHECKSUM_FILE)[:_CHECKSUM_DIGITS].decode() == _checksum(part)
    except (OSError, UnicodeDecodeError):
        return False


def _checksum_file(part: Path) -> Path:
    return part.with_name(f"_{part.name}.sha256")  # in the format of the program sha256sum


def _checksum(file: Path) -> str:
    digest = hashlib.sha256()
    with open_regular(file) as stream:
        while block := stream.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


_Job = tuple[str, "TrajectoryQuery", str]


def _in_processes(jobs: list[_Job], workers: int | None) -> Iterator[QueryResult]:
    workers = min(workers or os.cpu_count() or 1, max(len(jobs), 1))
    for job, result in run_jobs(jobs, workers):
        died = QueryResult(job[0], error="The process died, perhaps because it ran out of memory.")
        yield died if result is None else result


def _on_dask(jobs: list[_Job], workers: int | None) -> Iterator[QueryResult]:
    distributed = _module("distributed", "Dask", "pip install 'dask[distributed]'")
    options = {} if workers is None else {"n_workers": workers}
    with distributed.Client(**options) as client:
        futures = {client.submit(query_recording, *job, pure=False): job[0] for job in jobs}
        for future in distributed.as_completed(list(futures)):
            error = future.exception()
            yield future.result() if error is None else QueryResult(futures[future], error=f"Dask reports: {error}")


def _on_ray(jobs: list[_Job], workers: int | None) -> Iterator[QueryResult]:
    ray = _module("ray", "Ray", "pip install ray")
    is_ours = not ray.is_initialized()
    if is_ours:
        ray.init(log_to_driver=False, logging_level="ERROR")
    try:
        # A recording that crashes one worker would also crash the next one.
        remote = ray.remote(max_retries=0)(query_recording)
        left, waiting = list(reversed(jobs)), dict[Any, str]()
        while left or waiting:
            while left and (workers is None or len(waiting) < workers):
                job = left.pop()
                waiting[remote.remote(*job)] = job[0]
            (reference,), _ = ray.wait(list(waiting), num_returns=1)
            bag = waiting.pop(reference)
            try:
                result = ray.get(reference)
            except Exception as error:  # noqa: BLE001 - Ray's own errors: a worker that died, a node that is gone
                result = QueryResult(bag, error=f"Ray reports: {' '.join(str(error).split())[:300]}")
            yield result
    finally:
        if is_ours:
            ray.shutdown()


def _module(name: str, what: str, install: str) -> Any:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        raise RecordingError(f"{what} needs the package {name}, which is not installed", hint=install) from None


ENGINES: dict[str, Callable[[list[_Job], int | None], Iterator[QueryResult]]] = {
    "processes": _in_processes,
    "dask": _on_dask,
    "ray": _on_ray,
}
