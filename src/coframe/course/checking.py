# SPDX-License-Identifier: Apache-2.0
"""Grades of folders, each in an isolated process: one folder, or the folders of a class several at a time."""

from __future__ import annotations

import contextlib
import json
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe.course.grading import CRITERIA
from coframe.course.isolation import isolated_command, isolated_environment
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["check_class", "check_folder", "submissions"]

_LIMIT = 180.0  # seconds of real time for one folder
_PERIOD = 0.05  # seconds between two looks at the progress


def check_folder(
    folder: Path,
    *,
    variant: int | None = None,
    only: tuple[str, ...] = CRITERIA,
    record: Path | None = None,
    progress: Callable[[int], object] = lambda _done: None,
    number: int = 0,
) -> dict[str, Any]:
    """Grade a student's folder in an isolated process.

    Args:
        folder: The folder.
        variant: The variant of the assignment. None: the one in the folder's ``lab.json``.
        only: The criteria to check.
        record: A folder for a recording of everything that was published.
        progress: Called with the number of criteria that are done.
        number: Number of this grade among those that run at the same time.

    Returns:
        The report, as `Report.as_dict` describes it.

    Raises:
        CourseError: The folder does not exist, its assignment is damaged, or it could not be graded in time.
    """
    if not folder.is_dir():
        raise CourseError(f"There is no folder {folder}.", hint="Create one with coframe lab new.")
    with tempfile.TemporaryDirectory(prefix="coframe-check-", ignore_cleanup_errors=True) as scratch:
        result, log = Path(scratch, "result.jsonl"), Path(scratch, "log")
        words = [str(folder.resolve()), str(result), "own" if variant is None else str(variant), ",".join(only)]
        words += [str(record.resolve())] if record is not None else []
        with log.open("wb") as output:
            process = subprocess.Popen(  # noqa: S603 - this Python, with arguments of ours
                isolated_command([sys.executable, "-m", "coframe.course.grading", *words]),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=output,
                env=isolated_environment(number),
                start_new_session=True,
            )
        try:
            _follow(process, result, progress)
        finally:
            process.kill()
            process.wait()
        report = _last(result, "report")
        if isinstance(report, dict):
            return report
        error = _last(result, "error")
        if isinstance(error, list):
            raise CourseError(error[0], hint=error[1])
        last = log.read_text(errors="replace").strip().splitlines()[-1:]
        reason = last[0] if last else f"it took more than {_LIMIT:g} s" if process.returncode else "it ended early"
        raise CourseError(f"{folder} could not be graded: {reason}", hint="coframe lab run shows what its nodes print.")


def submissions(folder: Path) -> list[Path]:
    """Return the folders of a class: each folder in `folder` that contains a file of the lab, at any depth of two.

    Raises:
        CourseError: There is none.
    """
    files = [*folder.glob("*/*.py"), *folder.glob("*/*/*.py")]
    found = sorted({path.parent for path in files})
    if not found:
        raise CourseError(
            f"No submissions in {folder}.", hint="It must contain a folder for each student, with the student's files."
        )
    return found


def check_class(
    folders: list[Path], *, jobs: int = 2, variant: int | None = None, only: tuple[str, ...] = CRITERIA
) -> Iterator[tuple[Path, dict[str, Any] | CourseError]]:
    """Grade several folders at the same time.

    Args:
        folders: The folders.
        jobs: How many to grade at a time.
        variant: The variant of all assignments. None: that in each folder.
        only: The criteria to check.

    Yields:
        Each folder with its report, or with the error that prevented it, in the order in which they are done.
    """

    def check(number: int) -> dict[str, Any]:
        return check_folder(folders[number], variant=variant, only=only, number=number)

    with ThreadPoolExecutor(jobs) as pool:
        running = {pool.submit(check, number): folder for number, folder in enumerate(folders)}
        for done in as_completed(running):
            error = done.exception()
            if error is not None and not isinstance(error, CourseError):
                raise error
            yield running[done], done.result() if error is None else error


def _follow(process: subprocess.Popen[bytes], result: Path, progress: Callable[[int], object]) -> None:
    """Report the progress until the process ends or its time is over."""
    deadline = time.monotonic() + _LIMIT
    while process.poll() is None and time.monotonic() < deadline:
        progress(sum(1 for kind, _ in _lines(result) if kind == "done"))
        time.sleep(_PERIOD)


def _last(result: Path, wanted: str) -> Any:
    values = [value for kind, value in _lines(result) if kind == wanted]
    return values[-1] if values else None


def _lines(result: Path) -> Iterator[tuple[str, Any]]:
    """Yield the complete lines of a result file."""
    with contextlib.suppress(OSError, ValueError):
        for line in result.read_text(encoding="utf-8").splitlines():
            yield next(iter(json.loads(line).items()))
