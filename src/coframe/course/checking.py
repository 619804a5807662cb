# SPDX-License-Identifier: Apache-2.0
"""Grades of folders, each in an isolated process: one folder, or the folders of a class several at a time."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from coframe.course.folders import file_names
from coframe.course.grading import CRITERIA
from coframe.course.isolation import isolated_command, isolated_environment
from coframe.errors import CourseError
from coframe.temporary_folders import temporary_folder

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Mapping

__all__ = ["check_class", "check_folder", "submissions"]

_LIMIT = 400.0  # seconds of real time for one folder; nine programs that never respond need about half of it
_PERIOD = 0.05  # seconds between two looks at the progress


def check_folder(
    folder: Path,
    *,
    variant: int | None = None,
    only: tuple[str, ...] = CRITERIA,
    record: Path | None = None,
    progress: Callable[[int], object] = lambda _done: None,
    number: int = 0,
    cancelled: threading.Event | None = None,
) -> dict[str, Any]:
    """Grade a student's folder in an isolated process.

    Args:
        folder: The folder.
        variant: The variant of the assignment. None: the one in the folder's ``lab.json``.
        only: The criteria to check.
        record: A folder for a recording of everything that was published.
        progress: Called with the number of criteria that are done.
        number: Number of this grade among those that run at the same time.
        cancelled: Ends the grade when it is set.

    Returns:
        The report, as `Report.as_dict` describes it.

    Raises:
        CourseError: The folder does not exist, its assignment is damaged, or it could not be graded in time.
    """
    if not folder.is_dir():
        raise CourseError(f"There is no folder {folder}.", hint="Create one with coframe lab new.")
    with temporary_folder("coframe-check-") as name:
        scratch, log = Path(name, "scratch"), Path(name, "log")
        scratch.mkdir()
        words = [str(folder.resolve()), str(scratch), "own" if variant is None else str(variant), ",".join(only)]
        words += [str(record.resolve())] if record is not None else []
        with log.open("wb") as errors:
            process = subprocess.Popen(  # noqa: S603 - this Python, with arguments of ours
                isolated_command([sys.executable, "-m", "coframe.course.grading", *words]),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=errors,
                env=isolated_environment(number, scratch),
                start_new_session=True,
            )
        assert process.stdout is not None
        with process.stdout as output:
            results = _Results(output)
            try:
                results.follow(progress, cancelled or threading.Event())
            finally:
                process.kill()
                process.wait()
                results.join()
        if "report" in results.last:
            return dict(results.last["report"])
        if "error" in results.last:
            text, hint = results.last["error"]
            raise CourseError(text, hint=hint)
        lines = log.read_text(errors="replace").strip().splitlines()[-1:]
        reason = f"it took more than {_LIMIT:g} s" if results.is_late else lines[0] if lines else "the check was ended"
        raise CourseError(f"{folder} could not be graded: {reason}", hint="coframe lab run shows what its nodes print.")


def submissions(folder: Path) -> dict[str, Path]:
    """Return the submissions of a class: the name of each folder in `folder`, and where its files of the lab are.

    A folder without any such file is a submission too. Hidden folders, and those that macOS adds to archives, are not.

    Raises:
        CourseError: There is none.
    """
    students = [path for path in sorted(folder.glob("*/")) if path.is_dir() and not path.name.startswith((".", "__"))]
    if not students:
        raise CourseError(
            f"No submissions in {folder}.", hint="It must contain a folder for each student, with the student's files."
        )
    return {student.name: _lab_below(student) for student in students}


def _lab_below(student: Path) -> Path:
    """Return the folder with most files of the lab, at most two levels below the folder of a student."""
    names = file_names()
    candidates = [student, *sorted(student.glob("*/")), *sorted(student.glob("*/*/"))]
    return max(candidates, key=lambda path: sum((path / name).is_file() for name in names))


def check_class(
    folders: Mapping[str, Path], *, jobs: int = 2, variant: int | None = None, only: tuple[str, ...] = CRITERIA
) -> Generator[tuple[str, dict[str, Any] | CourseError], None, None]:
    """Grade several folders at the same time.

    Args:
        folders: The folders by the names of their submissions.
        jobs: How many to grade at a time.
        variant: The variant of all assignments. None: that in each folder.
        only: The criteria to check.

    Yields:
        The name of each submission with its report, or with the error that prevented it, in the order in which they
        are done.
    """

    def check(number: int) -> dict[str, Any]:
        folder = list(folders.values())[number]
        return check_folder(folder, variant=variant, only=only, number=number, cancelled=cancelled)

    cancelled = threading.Event()
    with ThreadPoolExecutor(jobs) as pool:
        running = {pool.submit(check, number): name for number, name in enumerate(folders)}
        try:
            for done in as_completed(running):
                error = done.exception()
                if error is not None and not isinstance(error, CourseError):
                    raise error
                yield running[done], done.result() if error is None else error
        finally:  # Ctrl-C ends the grades that run, and no other one starts.
            cancelled.set()
            pool.shutdown(wait=False, cancel_futures=True)


class _Results(threading.Thread):
    """Reads the lines of JSON that a grade prints.

    Attributes:
        last: The last value of each kind.
        is_late: Whether the grade took too long.
    """

    def __init__(self, output: IO[bytes]) -> None:
        super().__init__(daemon=True)
        self.last: dict[str, Any] = {}
        self.is_late = False
        self._output = output
        self._done = 0

    def run(self) -> None:
        """Read until the grade ends."""
        for line in self._output:
            if not line.endswith(b"\n"):  # The grade was ended meanwhile.
                break
            for kind, value in json.loads(line).items():
                self.last[kind] = value
                self._done += kind == "done"

    def follow(self, progress: Callable[[int], object], cancelled: threading.Event) -> None:
        """Report the progress until the grade ends, its time is over, or it is cancelled."""
        self.start()
        deadline = time.monotonic() + _LIMIT
        while self.is_alive() and not cancelled.wait(_PERIOD):
            progress(self._done)
            if time.monotonic() > deadline:
                self.is_late = True
                return
