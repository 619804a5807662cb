# SPDX-License-Identifier: Apache-2.0
"""Create folders for students: stubs with a task in each docstring, an RViz configuration, and a README."""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from coframe._files.complete_files import write_complete
from coframe.course.assignment import ASSIGNMENT_FILE, assignment_file, assignment_of
from coframe.errors import CourseError

if TYPE_CHECKING:
    from coframe.course.assignment import Assignment

__all__ = ["create_folder", "file_names"]

_TEMPLATES = Path(__file__).parent / "templates"
_SUFFIX = ".in"


def create_folder(folder: Path, variant: int | None) -> list[Path]:
    """Create a folder with the files of the lab.

    Args:
        folder: The folder; it must not contain files of these names.
        variant: The seed of a variant. None for the lab's own parameters.

    Returns:
        The files.

    Raises:
        CourseError: A file already exists, or cannot be written.
    """
    assignment = assignment_of(variant)
    names = file_names()
    existing = [name for name in (ASSIGNMENT_FILE, *names) if (folder / name).exists()]
    if existing:
        raise CourseError(
            f"{folder} already contains {', '.join(existing)}.", hint="Choose another folder: nothing is overwritten."
        )
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in names:
            text = (_TEMPLATES / f"{name}{_SUFFIX}").read_text(encoding="utf-8")
            write_complete(folder / name, _fill_template(text, assignment).encode())
        write_complete(folder / ASSIGNMENT_FILE, assignment_file(assignment).encode())
    except OSError as error:
        for name in (*names, ASSIGNMENT_FILE):
            with suppress(OSError):  # The file was not written yet.
                (folder / name).unlink()
        raise CourseError(
            f"Cannot write {error.filename or folder}: {error.strerror}.", hint="Choose another folder."
        ) from None
    return [folder / name for name in (*names, ASSIGNMENT_FILE)]


def file_names() -> list[str]:
    """Return the names of the files of the lab."""
    return sorted(path.name.removesuffix(_SUFFIX) for path in _TEMPLATES.glob(f"*{_SUFFIX}"))


def _fill_template(text: str, assignment: Assignment) -> str:
    """Return a template filled with the parameters of the assignment."""
    first, second = assignment.link_lengths
    values = {
        "CAMERA": _numbers(assignment.camera.translation),
        "IMU": _numbers(assignment.imu.translation),
        "LIDAR": _numbers(assignment.lidar.translation),
        "HEIGHT": f"{assignment.base_height:g}",
        "LENGTH1": f"{first:g}",
        "LENGTH2": f"{second:g}",
        "DYNAMIC_RATE": f"{assignment.dynamic_rate:g}",
        "LISTENER_RATE": f"{assignment.listener_rate:g}",
        "VARIANT": "These are the numbers of the lab."
        if assignment.variant is None
        else f"These are the numbers of variant {assignment.variant}.",
    }
    return re.sub(r"@([A-Z0-9_]+)@", lambda match: values[match[1]], text)


def _numbers(values: tuple[float, ...]) -> str:
    return "[" + ", ".join(f"{value:g}" for value in values) + "]"
