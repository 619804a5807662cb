"""One question to many recordings at once; the answers are one Parquet dataset, a file a recording.

:func:`answer` is the whole work for one recording, a plain function of values that can be pickled. Here it runs in
processes; those who have more machines hand it to Dask or Ray.
"""

from __future__ import annotations

import concurrent.futures
import hashlib
import importlib
import json
import multiprocessing
import os
import signal
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.bags.recording import open_bag
from coframe.bags.table import POSE_COLUMNS
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from coframe.bags.questions import Question
    from coframe.transform import Transform

__all__ = ["ENGINES", "Answer", "answer", "answer_all"]

_ABOUT = b"coframe"


class Answer(NamedTuple):
    """What became of one recording.

    Attributes:
        bag: Its path.
        poses: How many poses were written.
        missing: How many times were left out because there is no transform.
        problems: What could not be read of the recording, or is odd.
        error: Why there is no answer; "" if there is one.
        kept: Whether it was there from an earlier run.
    """

    bag: str
    poses: int = 0
    missing: int = 0
    problems: tuple[str, ...] = ()
    error: str = ""
    kept: bool = False


def answer(bag: str, question: Question, folder: str) -> Answer:
    """Asks one recording and writes its file into the dataset; never raises.

    A file that is there already, for the same question and the same state of the recording, is kept.

    Args:
        bag: The recording's path.
        question: What to ask.
        folder: The dataset's folder, which must be there.

    Returns:
        What became of it. The file has the columns ``bag``, ``stamp_ns``, ``x`` ... ``qw``.
    """
    try:
        return _answer(bag, question, Path(folder))
    except Exception as error:  # noqa: BLE001 - one recording must never stop the others
        parts = (str(error) or type(error).__name__, getattr(error, "hint", ""))
        return Answer(bag, error=". ".join(" ".join(part.split()).rstrip(".") for part in parts if part) + ".")


def answer_all(
    bags: Sequence[str | os.PathLike[str]],
    question: Question,
    folder: str | os.PathLike[str],
    *,
    on: str = "processes",
    workers: int | None = None,
    progress: Callable[[Answer], object] = lambda _answer: None,
) -> list[Answer]:
    """Asks many recordings the same, in parallel; what is there from an earlier run is kept.

    Args:
        bags: Their paths; of one that is named twice, the second is left out.
        question: What to ask.
        folder: The dataset: a Parquet file for each recording, which pyarrow (``pyarrow.dataset.dataset(folder)``),
            pandas, Dask and DuckDB read as one.
        on: ``"processes"`` of this machine; ``"dask"``, the cluster that ``DASK_SCHEDULER_ADDRESS`` or Dask's
            configuration names, or one of its own on this machine; ``"ray"`` likewise, with ``RAY_ADDRESS``. With
            these, bags and folder must be where the workers find them, and coframe must be installed there.
        workers: How many at once; by default as many as processors, with Dask and Ray what they take.
        progress: Told of each answer as it comes.

    Returns:
        The answers in the order of the recordings. A recording that cannot be read has its reason there.

    Raises:
        RecordingError: pyarrow, Dask or Ray is not installed, or the folder cannot be made.
        ValueError: There is no such engine.
    """
    if on not in ENGINES:
        raise ValueError(f"there is nothing called {on!r} to run on: it is one of {', '.join(ENGINES)}")
    _module("pyarrow", "Parquet", "'coframe[parquet]'")
    target = Path(folder).absolute()
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise RecordingError(
            f"the folder {target} cannot be made: {error.strerror or error}", hint="Name another one."
        ) from None
    paths = list(dict.fromkeys(str(Path(bag).absolute()) for bag in bags))
    answers = {}
    for one in ENGINES[on]([(path, question, str(target)) for path in paths], workers):
        answers[one.bag] = one
        progress(one)
    return [answers[path] for path in paths]


def _answer(bag: str, question: Question, folder: Path) -> Answer:
    about = _about(bag, question)
    part = folder / f"{Path(bag).stem}-{hashlib.sha256(bag.encode()).hexdigest()[:12]}.parquet"
    if (poses := _rows_there(part, about)) is not None:
        return Answer(bag, poses, kept=True)
    chosen: Any = {"namespace": question.namespace, "tf_topics": question.tf_topics}
    with open_bag(bag, **chosen, prefix=question.prefix, keep=question.keep) as recording:
        found, missing = question.ask(recording)
        problems = tuple(recording.problems)
    _write(part, bag, found, about)
    return Answer(bag, len(found) if found.shape else 1, missing, problems)


def _about(bag: str, question: Question) -> bytes:
    """What the file answers: the question, and the state of what was asked."""
    path = Path(bag)
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    state = [(file.name, file.stat().st_size, file.stat().st_mtime_ns) for file in files if file.is_file()]
    return json.dumps({"question": asdict(question), "state": state}, sort_keys=True).encode()


def _rows_there(part: Path, about: bytes) -> int | None:
    """How many poses an earlier run has written for the same; None if it has not."""
    if not part.exists():
        return None
    try:
        metadata = importlib.import_module("pyarrow.parquet").read_metadata(part)
    except Exception:  # noqa: BLE001 - whatever is wrong with it, it is written again
        return None
    return int(metadata.num_rows) if (metadata.metadata or {}).get(_ABOUT) == about else None


def _write(part: Path, bag: str, poses: Transform, about: bytes) -> None:
    arrow: Any = importlib.import_module("pyarrow")
    parquet: Any = importlib.import_module("pyarrow.parquet")
    values = np.concatenate([np.atleast_2d(poses.translation), np.atleast_2d(poses.quaternion)], axis=1)
    stamps = np.zeros(1, dtype=np.int64) if poses.stamps is None else poses.stamps
    columns = {"bag": arrow.array([bag] * len(values)).dictionary_encode(), "stamp_ns": stamps}
    columns |= dict(zip(POSE_COLUMNS, values.T.copy(), strict=True))
    temporary = part.with_name(f"_{part.name}.{os.getpid()}")  # what begins so is in no dataset
    try:
        parquet.write_table(arrow.table(columns).replace_schema_metadata({_ABOUT: about}), temporary)
        temporary.replace(part)
    finally:
        temporary.unlink(missing_ok=True)


_Job = tuple[str, "Question", str]


def _in_processes(jobs: list[_Job], workers: int | None) -> Iterator[Answer]:
    """As many jobs are given out as there are processes, so that one that dies takes no more than those with it."""
    workers = min(workers or os.cpu_count() or 1, max(len(jobs), 1))
    waiting = list(reversed(jobs))
    while waiting:
        suspects = yield from _in_pool(waiting, workers)
        # One of these has ended its process: each has one of its own now.
        for job in suspects:
            alone = [job]
            if (yield from _in_pool(alone, 1)):
                yield Answer(job[0], error="its process died: was there too little memory?")


def _in_pool(waiting: list[_Job], workers: int) -> Any:
    """Takes jobs from the end of the list; those that were under way when a process died are returned."""
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(workers, context, initializer=_end_at_interrupt) as pool:
        running: dict[concurrent.futures.Future[Answer], _Job] = {}
        try:
            while waiting or running:
                while waiting and len(running) < workers:
                    with _interrupts_waiting():
                        running[pool.submit(answer, *waiting[-1])] = waiting[-1]
                    waiting.pop()
                done, _ = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
                for future in done:
                    found = future.result()
                    del running[future]
                    yield found
        except concurrent.futures.process.BrokenProcessPool:
            return list(running.values())
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
    return []


@contextmanager
def _interrupts_waiting() -> Iterator[None]:
    """Ctrl-C has to wait until processes have been started: they inherit that, and say nothing while they load."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _end_at_interrupt() -> None:
    """At Ctrl-C without a word: the one who asks has one."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})


def _on_dask(jobs: list[_Job], workers: int | None) -> Iterator[Answer]:
    distributed = _module("distributed", "Dask", "'dask[distributed]'")
    options = {} if workers is None else {"n_workers": workers}
    with distributed.Client(**options) as client:
        futures = {client.submit(answer, *job, pure=False): job[0] for job in jobs}
        for future in distributed.as_completed(list(futures)):
            error = future.exception()
            yield future.result() if error is None else Answer(futures[future], error=f"Dask says: {error}")


def _on_ray(jobs: list[_Job], workers: int | None) -> Iterator[Answer]:
    ray = _module("ray", "Ray", "ray")
    is_ours = not ray.is_initialized()
    if is_ours:
        ray.init(log_to_driver=False, logging_level="ERROR")
    try:
        remote = ray.remote(max_retries=0)(answer)  # what ended one process would end the next
        left, waiting = list(reversed(jobs)), dict[Any, str]()
        while left or waiting:
            while left and (workers is None or len(waiting) < workers):
                job = left.pop()
                waiting[remote.remote(*job)] = job[0]
            (reference,), _ = ray.wait(list(waiting), num_returns=1)
            bag = waiting.pop(reference)
            try:
                found = ray.get(reference)
            except Exception as error:  # noqa: BLE001 - Ray's own: a worker that died, a node that is gone
                found = Answer(bag, error=f"Ray says: {' '.join(str(error).split())[:300]}")
            yield found
    finally:
        if is_ours:
            ray.shutdown()


def _module(name: str, what: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        raise RecordingError(f"{what} needs the package {name}", hint=f"pip install {package}") from None


ENGINES: dict[str, Callable[[list[_Job], int | None], Iterator[Answer]]] = {
    "processes": _in_processes,
    "dask": _on_dask,
    "ray": _on_ray,
}
