# SPDX-License-Identifier: Apache-2.0
"""Local worker processes for many recordings. A crash affects only its own recording."""

from __future__ import annotations

import pickle
import queue
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import TYPE_CHECKING, Any

from coframe._process.own_group import own_group
from coframe._process.python_children import python_command, python_environment

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

__all__ = ["run_jobs"]


def run_jobs(jobs: Sequence[tuple[Any, ...]], workers: int) -> Iterator[tuple[tuple[Any, ...], Any]]:
    """Call `coframe.bags.batch.query_recording` for each job in worker processes.

    A job whose process dies is run again, because concurrent jobs may have used the memory.

    Args:
        jobs: The arguments of each call.
        workers: The number of processes.

    Yields:
        Each job with its result, in order of completion; the result is None if its process died twice.
    """
    pool = _Pool()
    with ThreadPoolExecutor(workers) as threads:
        running = {threads.submit(pool.run, job): job for job in jobs}
        try:
            for done in as_completed(running):
                yield running[done], done.result()
        finally:
            threads.shutdown(wait=False, cancel_futures=True)
            pool.close()


class _Pool:
    """Worker processes, started on demand. Thread-safe."""

    def __init__(self) -> None:
        self._idle_workers: queue.SimpleQueue[_Worker] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._workers: list[_Worker] = []
        self._closed = False

    def run(self, job: tuple[Any, ...]) -> Any:
        for _ in range(2):
            worker = self._take_idle_worker()
            if worker is None:
                return None
            try:
                result = worker.run(job)
            except (OSError, EOFError, pickle.UnpicklingError):
                worker.close()
                continue
            self._idle_workers.put(worker)
            return result
        return None

    def close(self) -> None:
        """End all processes, including busy ones."""
        with self._lock:
            self._closed = True
            for worker in self._workers:
                worker.close()

    def _take_idle_worker(self) -> _Worker | None:
        try:
            return self._idle_workers.get_nowait()
        except queue.Empty:
            pass
        with self._lock:
            if self._closed:
                return None
            worker = _Worker()
            self._workers.append(worker)
            return worker


class _Worker:
    """A process that receives the arguments of calls and sends their results."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(  # noqa: S603 - a module of coframe
            python_command("coframe.bags._batch_worker"),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=python_environment(),
            **own_group(),  # Only the parent receives Ctrl-C; it then ends the workers.
        )
        self._send(sys.path)

    def run(self, job: tuple[Any, ...]) -> Any:
        """Return the result of a call.

        Raises:
            OSError: The process had already ended.
            EOFError: The process ended during the call.
        """
        self._send(job)
        assert self._process.stdout is not None
        return pickle.load(self._process.stdout)  # noqa: S301 - from a process of ours

    def _send(self, value: Any) -> None:
        assert self._process.stdin is not None
        pickle.dump(value, self._process.stdin)
        self._process.stdin.flush()

    def close(self) -> None:
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            assert stream is not None
            try:
                stream.close()
            except OSError:  # What was not sent yet is lost with the process.
                continue
