# SPDX-License-Identifier: Apache-2.0
"""Grade one folder in a separate process: `main` prints the result as JSON."""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from coframe._process.python_children import python_command, python_environment
from coframe.course._confinement import DECOYS, Confinement
from coframe.course._processes import adopt_orphans
from coframe.course._program import HOMES
from coframe.course.assignment import Assignment, assignment_of, read_assignment
from coframe.course.isolation import bring_loopback_up, is_isolated, limit_disk
from coframe.course.rubric import RUBRIC
from coframe.course.sandbox.privileges import forbid_tracing
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from coframe.course._sheet import Sheet

__all__ = ["main"]

_SEARCHABLE_MODE = 0o711


def main() -> None:
    """Grade a folder, and print the assignment and each completed criterion as lines of JSON.

    The argument is JSON: "folder"; "scratch", an empty folder; "variant", null for that of the folder; "only", the
    criteria; "number", that of the grade among those at the same time; "record", a folder for a recording or null; and
    "private", see `private_folders`.
    """
    threading.Thread(target=_end_with_parent, daemon=True).start()
    job = json.loads(sys.argv[1])
    folder, scratch = Path(job["folder"]), Path(job["scratch"])
    with contextlib.suppress(OSError):
        forbid_tracing()
    bring_loopback_up()
    homes = scratch / HOMES
    for path in (
        homes,
        scratch / DECOYS,
    ):  # No other process on this machine can see these disks or open files on them.
        path.mkdir()
        limit_disk(path)
    for path in (scratch.parent, scratch, homes):
        path.chmod(_SEARCHABLE_MODE)  # If this process runs as root, programs run as other users.
    adopt_orphans()
    signal.signal(signal.SIGINT, lambda _number, _frame: None)  # A program can send this signal to its parent.
    confinement = Confinement(folder, scratch, job["private"], has_namespaces=is_isolated(), number=job["number"])
    with _result_output() as output, _record_topics(job["record"]), confinement:

        def write(kind: str, value: Any) -> None:
            output.write(json.dumps({kind: value}) + "\n")
            output.flush()

        try:
            assignment = read_assignment(folder) if job["variant"] is None else assignment_of(job["variant"])
            write("variant", assignment.variant)
            _grade(folder, assignment, scratch, confinement, job["only"], lambda sheet: write("sheet", sheet.as_dict()))
        except CourseError as error:
            write("error", [str(error), error.hint])


def _end_with_parent() -> None:
    """End this process, and with it its namespaces, when the process that wants the grade has ended."""
    while os.read(sys.stdin.fileno(), 1):
        pass
    os._exit(1)


def _grade(
    folder: Path,
    assignment: Assignment,
    scratch: Path,
    confinement: Confinement,
    only: Sequence[str],
    on_sheet: Callable[[Sheet], None],
) -> None:
    """Run a student's nodes next to a simulated robot.

    Args:
        folder: The student's folder.
        assignment: The parameters that the nodes have to use.
        scratch: An empty folder for the output of the nodes and the files that they write.
        confinement: The restrictions of the nodes.
        only: The criteria to check.
        on_sheet: Called with the sheet of each criterion.
    """
    from coframe.course._world import World  # noqa: PLC0415
    from coframe.course.criteria.common import Task  # noqa: PLC0415 - the criteria import rclpy, which takes time

    with World() as world:
        task = Task(folder, assignment, world, scratch, confinement)
        for name in RUBRIC:
            if name in only:
                on_sheet(importlib.import_module(f"coframe.course.criteria.{name}").check(task))


def _result_output() -> TextIO:
    """Return standard output as a file that children do not inherit; redirect it to standard error from then on."""
    output = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    return output


@contextlib.contextmanager
def _record_topics(folder: str | None) -> Iterator[None]:
    """Record all topics during the block, if there is a folder for it."""
    if folder is None:
        yield
        return
    command = python_command("coframe.cli", "record", "--output", folder)
    recorder = subprocess.Popen(command, env=python_environment(), stdin=subprocess.DEVNULL)  # noqa: S603
    try:
        yield
    finally:
        recorder.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)
        recorder.wait()


if __name__ == "__main__":
    main()
