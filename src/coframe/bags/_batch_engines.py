# SPDX-License-Identifier: Apache-2.0
"""Where the recordings of a batch are read: processes of this machine, Dask or Ray. Each yields jobs with results."""

from __future__ import annotations

import importlib
import os
from typing import TYPE_CHECKING, Any

from coframe.bags._batch_processes import run_jobs
from coframe.bags._batch_results import QueryResult
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe._sources.sources import Readable
    from coframe.bags._trajectory_query import TrajectoryQuery
    from coframe.bags.tables import TableQuery

    Job = tuple[Readable, TrajectoryQuery | TableQuery, str]
    Engine = Callable[[Callable[..., QueryResult], list[Job], int | None], Iterator[tuple[Job, QueryResult]]]

__all__ = ["ENGINES", "optional_module"]


def _in_processes(
    _function: Callable[..., QueryResult], jobs: list[Job], workers: int | None
) -> Iterator[tuple[Job, QueryResult]]:
    workers = min(workers or os.cpu_count() or 1, max(len(jobs), 1))
    for job, result in run_jobs(jobs, workers):
        yield (
            job,
            _failed_result(job, "The process died, perhaps because it ran out of memory.")
            if result is None
            else result,
        )


def _on_dask(
    function: Callable[..., QueryResult], jobs: list[Job], workers: int | None
) -> Iterator[tuple[Job, QueryResult]]:
    distributed = optional_module("distributed", "Dask", "pip install 'dask[distributed]'")
    options = {} if workers is None else {"n_workers": workers}
    with distributed.Client(**options) as client:
        futures = {client.submit(function, *job, pure=False): job for job in jobs}
        for future in distributed.as_completed(list(futures)):
            error, job = future.exception(), futures[future]
            yield job, future.result() if error is None else _failed_result(job, f"Dask reports: {error}")


def _on_ray(
    function: Callable[..., QueryResult], jobs: list[Job], workers: int | None
) -> Iterator[tuple[Job, QueryResult]]:
    ray = optional_module("ray", "Ray", "pip install ray")
    is_ours = not ray.is_initialized()
    if is_ours:
        ray.init(log_to_driver=False, logging_level="ERROR")
    try:
        # A recording that crashes one worker would also crash the next one.
        remote = ray.remote(max_retries=0)(function)
        left, waiting = list(reversed(jobs)), dict[Any, Any]()
        while left or waiting:
            while left and (workers is None or len(waiting) < workers):
                job = left.pop()
                waiting[remote.remote(*job)] = job
            (reference,), _ = ray.wait(list(waiting), num_returns=1)
            job = waiting.pop(reference)
            try:
                result = ray.get(reference)
            except Exception as error:  # noqa: BLE001 - Ray's own errors: a worker that died, a node that is gone
                result = _failed_result(job, f"Ray reports: {' '.join(str(error).split())[:300]}")
            yield job, result
    finally:
        if is_ours:
            ray.shutdown()


def _failed_result(job: Job, error: str) -> QueryResult:
    return QueryResult(str(job[0]), error=error, reason="failed")


def optional_module(name: str, what: str, install: str) -> Any:
    """Import a package.

    Args:
        name: The name of the package.
        what: What needs it; the subject of the error message.
        install: The command that installs it.

    Raises:
        RecordingError: It is not installed.
    """
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        raise RecordingError(f"{what} needs the package {name}, which is not installed", hint=install) from None


ENGINES: dict[str, Engine] = {"processes": _in_processes, "dask": _on_dask, "ray": _on_ray}
