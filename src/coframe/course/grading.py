# SPDX-License-Identifier: Apache-2.0
"""The grade of one folder: ``python -m coframe.course.grading FOLDER SCRATCH`` prints it as JSON."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from coframe.course.assignment import Assignment, assignment_of, read_assignment
from coframe.course.isolation import bring_loopback_up, limit_disk
from coframe.course.processes import adopt_orphans
from coframe.course.program import HOMES
from coframe.course.sheet import Report
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["CRITERIA", "grade"]

# The modules of coframe.course.criteria, in the order of the rubric; those after the first five are extensions.
CRITERIA = (
    "static",
    "dynamic",
    "listener",
    "sensor",
    "visualization",
    "urdf",
    "time_travel",
    "several_robots",
    "monitor",
)


def grade(
    folder: Path, assignment: Assignment, scratch: Path, only: tuple[str, ...], done: Callable[[str], None]
) -> Report:
    """Run a student's nodes next to a simulated robot, and return the grade.

    Args:
        folder: The student's folder.
        assignment: The numbers that the nodes have to use.
        scratch: An empty folder for the output of the nodes and the files that they write.
        only: The criteria to check.
        done: Called with the name of each criterion after it was checked.
    """
    import importlib  # noqa: PLC0415 - the criteria import rclpy, which takes time

    from coframe.course.criteria.common import Task  # noqa: PLC0415
    from coframe.course.world import World  # noqa: PLC0415

    report = Report(str(folder), assignment.variant, [])
    with World() as world:
        task = Task(folder, assignment, world, scratch)
        for name in CRITERIA:
            if name in only:
                report.sheets.append(importlib.import_module(f"coframe.course.criteria.{name}").check(task))
                done(name)
    return report


def main() -> None:
    """Grade the folder in the first argument; print the report, and progress, as lines of JSON.

    The other arguments are an empty folder, the variant ("own": that of the folder), the criteria, and a folder for a
    recording.
    """
    folder, scratch, variant, only = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3], tuple(sys.argv[4].split(","))
    bring_loopback_up()
    homes = scratch / HOMES
    homes.mkdir()
    limit_disk(homes)
    adopt_orphans()
    signal.signal(signal.SIGINT, lambda _number, _frame: None)  # A program can send it to its parent.
    with _result_output() as output, _recorded(sys.argv[5:]):

        def write(kind: str, value: Any) -> None:
            output.write(json.dumps({kind: value}) + "\n")
            output.flush()

        try:
            assignment = read_assignment(folder) if variant == "own" else assignment_of(int(variant))
            report = grade(folder, assignment, scratch, only, lambda name: write("done", name))
        except CourseError as error:
            write("error", [str(error), error.hint])
        else:
            write("report", report.as_dict())


def _result_output() -> TextIO:
    """Return the standard output as a file that no other process gets; from then on, it is the standard error."""
    output = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    return output


@contextlib.contextmanager
def _recorded(folder: list[str]) -> Iterator[None]:
    """Record all topics during the block, if there is a folder for it."""
    if not folder:
        yield
        return
    command = [sys.executable, "-m", "coframe.cli", "record", "--output", folder[0]]
    recorder = subprocess.Popen(command, stdin=subprocess.DEVNULL)  # noqa: S603 - a command of coframe
    try:
        yield
    finally:
        recorder.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)
        recorder.wait()


if __name__ == "__main__":
    main()
