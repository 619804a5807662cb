# SPDX-License-Identifier: Apache-2.0
"""Grade folders, each in an isolated process: a single folder, or a class with several folders at a time."""

from __future__ import annotations

import json
import signal
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from coframe._files.temporary_folders import temporary_folder
from coframe._process.own_group import own_group
from coframe._process.python_children import python_command
from coframe.course._sheet import GradeReport, Sheet
from coframe.course._view import private_folders
from coframe.course.isolation import isolated_command, isolated_environment, isolation_problem
from coframe.course.rubric import CRITERIA, RUBRIC
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from concurrent.futures import Future

    from coframe.course.class_folder import Submission

__all__ = ["MAX_SECONDS", "check_class", "check_folder"]

# Real time for one folder. On a loaded machine, nine programs that never respond need less, so that this limit does not
# decide about points.
MAX_SECONDS = 1200.0
_PERIOD = 0.05  # seconds between two progress checks
_EXIT_TIMEOUT = 5.0  # seconds between the end of the output of a grade and that of its process
_KILLED = 9  # SIGKILL, which Windows does not have


def check_folder(
    folder: Path,
    *,
    variant: int | None = None,
    only: tuple[str, ...] = CRITERIA,
    record: Path | None = None,
    progress: Callable[[int], object] = lambda _done: None,
    number: int = 0,
    cancelled: threading.Event | None = None,
    max_seconds: float = MAX_SECONDS,
) -> dict[str, Any]:
    """Grade a student's folder in an isolated process.

    If the time limit is reached or the process ends, the completed criteria count.

    Args:
        folder: The student's folder, which contains the programs.
        variant: The variant of the assignment. None for the one in the folder's ``lab.json``.
        only: The criteria to check.
        record: A folder for a recording of all published messages.
        progress: Called with the number of completed criteria.
        number: Number of this grade among concurrent ones.
        cancelled: Ends the grading when it is set.
        max_seconds: The limit on real time.

    Returns:
        The report, as `Report.as_dict` describes it.

    Raises:
        CourseError: The folder does not exist, its assignment is damaged, or no criterion could be checked.
    """
    if not folder.is_dir():
        raise CourseError(f"There is no folder {folder}.", hint="Create one with coframe lab new.")
    with temporary_folder("coframe-check-") as name:
        scratch, log = Path(name, "scratch"), Path(name, "log")
        scratch.mkdir()
        job = {
            "folder": str(folder.resolve()),
            "scratch": str(scratch),
            "variant": variant,
            "only": only,
            "number": number,
            "record": None if record is None else str(record.resolve()),
            "private": private_folders(folder),
        }
        with log.open("wb") as errors:
            process = subprocess.Popen(  # noqa: S603 - this Python, with arguments of ours
                isolated_command(python_command("coframe.course._grading", json.dumps(job))),
                stdin=subprocess.PIPE,  # The grade ends when it is closed, even if this process is killed.
                stdout=subprocess.PIPE,
                stderr=errors,
                cwd=scratch,
                env=isolated_environment(number, scratch),
                **own_group(),
            )
        assert process.stdin is not None
        assert process.stdout is not None
        with process.stdin, process.stdout as output:
            results = _Results(output, max_seconds)
            try:
                results.follow(progress, cancelled or threading.Event())
                ending = "the check was stopped" if results.is_alive() else _end_text(process)
            finally:
                process.kill()
                process.wait()
                results.join()
        lines = log.read_text(errors="replace").strip().splitlines()[-1:]
    if results.error is not None:
        text, hint = results.error
        raise CourseError(text, hint=hint)
    missing = [name for name in RUBRIC if name in only][len(results.sheets) :]
    if missing and not (results.sheets or results.is_late):
        reason = lines[0] if lines else ending
        raise CourseError(f"{folder} could not be graded: {reason}", hint="coframe lab run shows what its nodes print.")
    reason = f"the check took more than {max_seconds:g} s" if results.is_late else ending
    return _report(folder, results, missing, reason)


def _end_text(process: subprocess.Popen[bytes]) -> str:
    """Return how the process of a grade ended by itself, as a phrase."""
    try:
        code = process.wait(_EXIT_TIMEOUT)
    except subprocess.TimeoutExpired:
        return "the check wrote a line that is not a result"
    if code >= 0:
        return f"the check ended with exit code {code}"
    cause = ", as a system does that runs out of memory" if -code == _KILLED else ""
    return f"the check was ended by signal {-code} ({signal.strsignal(-code)}){cause}"


def _report(folder: Path, results: _Results, missing: Sequence[str], reason: str) -> dict[str, Any]:
    """Return the report of a grade, which may have ended early."""
    notices = [problem] if (problem := isolation_problem()) else []
    if missing:
        names = ", ".join(RUBRIC[name].name for name in missing)
        notices.append(f"{_capitalize(reason)}. These criteria were not checked: {names}. The other points count.")
    sheets = results.sheets + [Sheet.not_reached(RUBRIC[name], reason) for name in missing]
    return GradeReport(str(folder.resolve()), results.variant, sheets, notices).as_dict()


def check_class(
    students: Mapping[str, Submission],
    on_result: Callable[[str, dict[str, Any] | CourseError, bool], object],
    *,
    jobs: int = 2,
    variants: Mapping[str, int | None] | None = None,
    only: tuple[str, ...] = CRITERIA,
) -> None:
    """Grade several submissions at the same time.

    If it is interrupted, for example by Ctrl-C, the running grades are ended, and their completed criteria are also
    results.

    Args:
        students: The submissions by name.
        on_result: Called in this thread with the name of each submission, its report or error, and
            whether the grade is complete, in order of completion.
        jobs: Number of submissions to grade in parallel.
        variants: The variant of each submission. None, or no entry, for that in its folder.
        only: The criteria to check.
    """

    def check(number: int) -> dict[str, Any]:
        name, submission = list(students.items())[number]
        if submission.problem:
            raise CourseError(submission.problem)
        variant = None if variants is None else variants.get(name)
        return check_folder(submission.folder, variant=variant, only=only, number=number, cancelled=cancelled)

    def report(future: Future[dict[str, Any]], *, is_complete: bool) -> None:
        error = future.exception()
        if error is not None and not isinstance(error, CourseError):
            raise error
        if is_complete or error is None:
            on_result(running[future], future.result() if error is None else error, is_complete)

    cancelled = threading.Event()
    pool = ThreadPoolExecutor(jobs)
    running = {pool.submit(check, number): name for number, name in enumerate(students)}
    reported = set()
    try:
        for future in as_completed(running):
            reported.add(future)
            report(future, is_complete=True)
    finally:
        cancelled.set()
        pool.shutdown(wait=True, cancel_futures=True)
        for future in running:
            if future not in reported and not future.cancelled():
                report(future, is_complete=False)


def _capitalize(text: str) -> str:
    return text[:1].upper() + text[1:]


class _Results(threading.Thread):
    """Reads the lines of JSON that a grade prints.

    Attributes:
        variant: The variant of the assignment.
        sheets: The completed criteria.
        error: Why the folder cannot be graded, and what to do, or None if it can.
        is_late: Whether the grade took too long.
    """

    def __init__(self, output: IO[bytes], max_seconds: float) -> None:
        super().__init__(daemon=True)
        self.variant: int | None = None
        self.sheets: list[Sheet] = []
        self.error: tuple[str, str] | None = None
        self.is_late = False
        self._output = output
        self._max_seconds = max_seconds

    def run(self) -> None:
        """Read until the grading ends."""
        for line in self._output:
            if not line.endswith(b"\n"):  # The grading was ended in the meantime.
                break
            content = json.loads(line)
            if "sheet" in content:
                self.sheets.append(Sheet.from_dict(content["sheet"]))
            elif "error" in content:
                self.error = tuple(content["error"])
            else:
                self.variant = content["variant"]

    def follow(self, progress: Callable[[int], object], cancelled: threading.Event) -> None:
        """Report the progress until the grading ends, its time limit is reached, or it is cancelled."""
        self.start()
        deadline = time.monotonic() + self._max_seconds
        while self.is_alive() and not cancelled.wait(_PERIOD):
            progress(len(self.sheets))
            if time.monotonic() > deadline:
                self.is_late = True
                return
