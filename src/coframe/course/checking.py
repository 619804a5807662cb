# SPDX-License-Identifier: Apache-2.0
"""Grade folders, each in an isolated process: a single folder, or a class with several folders at a time."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from coframe._files.temporary_folders import temporary_folder
from coframe._process.python_children import python_command
from coframe.course._sheet import GradeReport, Sheet
from coframe.course._view import private_folders
from coframe.course.folders import file_names
from coframe.course.isolation import isolated_command, isolated_environment, isolation_problem
from coframe.course.rubric import CRITERIA, RUBRIC
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Mapping, Sequence

__all__ = ["MAX_SECONDS", "check_class", "check_folder", "submissions"]

MAX_SECONDS = 400.0  # real time for one folder; nine programs that never respond need about half of it
_MAX_FOLDERS = 200  # maximum number of files in a folder among which the files of the lab are searched
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
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=errors,
                cwd=scratch,
                env=isolated_environment(number, scratch),
                start_new_session=True,
            )
        assert process.stdout is not None
        with process.stdout as output:
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


def submissions(folder: Path) -> dict[str, Path]:
    """Return the submissions of a class: the name of each folder in `folder`, and the location of its lab files.

    A folder without such files is also a submission. Hidden folders, and those that macOS adds to archives, are not. A
    symbolic link to a folder is a submission that cannot be graded, because it may point to files of someone else.

    Raises:
        CourseError: There is none.
    """
    students = [path for path in sorted(folder.glob("*/")) if path.is_dir() and not path.name.startswith((".", "__"))]
    if not students:
        raise CourseError(
            f"No submissions in {folder}.",
            hint="The folder must contain a folder for each student, with the student's files.",
        )
    return {student.name: student if student.is_symlink() else _find_lab_folder(student) for student in students}


def _find_lab_folder(student: Path) -> Path:
    """Return the folder with the most lab files, at most two levels below the folder of a student.

    Links to folders are not followed, and links do not count as lab files.
    """
    names = file_names()
    candidates = [student, *_folders_in(student)]
    candidates += [below for folder in candidates[1:] for below in _folders_in(folder)]
    return max(candidates, key=lambda folder: sum(_is_own_file(folder / name) for name in names))


def _folders_in(folder: Path) -> list[Path]:
    """Return the folders in a folder of a student, without links; none if it cannot be read."""
    try:
        with os.scandir(folder) as entries:
            found = [entry.path for entry in entries if entry.is_dir(follow_symlinks=False)]
    except OSError:
        return []
    return [Path(path) for path in sorted(found)[:_MAX_FOLDERS]]


def _is_own_file(path: Path) -> bool:
    return path.is_file() and not path.is_symlink()


def check_class(
    folders: Mapping[str, Path], *, jobs: int = 2, variant: int | None = None, only: tuple[str, ...] = CRITERIA
) -> Generator[tuple[str, dict[str, Any] | CourseError], None, None]:
    """Grade several folders at the same time.

    Args:
        folders: The folders by submission name.
        jobs: Number of folders to grade in parallel.
        variant: The variant of all assignments. None for the one in each folder.
        only: The criteria to check.

    Yields:
        The name of each submission with its report, or with the error that prevented it, in order of completion.
    """

    def check(number: int) -> dict[str, Any]:
        name, folder = list(folders.items())[number]
        if folder.is_symlink():
            raise CourseError(
                f"{name} is a link to another folder. Links of submissions are not followed.",
                hint="Replace it with a copy of that folder, if it belongs to this student.",
            )
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
        finally:  # Ctrl-C ends the running grades, and no more are started.
            cancelled.set()
            pool.shutdown(wait=False, cancel_futures=True)


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
