# SPDX-License-Identifier: Apache-2.0
"""Create folders for students: stubs with a task in each docstring, an RViz configuration, and a README."""

from __future__ import annotations

import io
import re
import zipfile
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from coframe._files.complete_files import write_complete
from coframe._files.temporary_folders import temporary_folder
from coframe.course.assignment import ASSIGNMENT_FILE, assignment_file, assignment_of
from coframe.course.translation.catalogue import languages
from coframe.course.translation.language import ENGLISH, Language
from coframe.errors import CourseError

if TYPE_CHECKING:
    from coframe.course.assignment import Assignment
    from coframe.course.roster import Roster

__all__ = ["create_class", "create_folder", "file_names", "stub_texts"]

_TEMPLATES = Path(__file__).parent / "templates"
_SUFFIX = ".in"


def create_folder(folder: Path, variant: int | None, language: Language = ENGLISH) -> list[Path]:
    """Create a folder with the files of the lab.

    Args:
        folder: The folder; it must not contain files of these names.
        variant: The seed of a variant. None for the lab's own parameters.
        language: The language of the tasks.

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
            write_complete(folder / name, _filled(name, assignment, language).encode())
        write_complete(folder / ASSIGNMENT_FILE, assignment_file(assignment, language.code).encode())
    except OSError as error:
        for name in (*names, ASSIGNMENT_FILE):
            with suppress(OSError):  # The file was not written yet.
                (folder / name).unlink()
        raise CourseError(
            f"Cannot write {error.filename or folder}: {error.strerror}.", hint="Choose another folder."
        ) from None
    return [folder / name for name in (*names, ASSIGNMENT_FILE)]


def create_class(folder: Path, roster: Roster, *, as_zip: bool = False, language: Language = ENGLISH) -> list[Path]:
    """Create a folder for each student of a class, with the student's variant, and return them.

    Args:
        folder: The folder of the class.
        roster: The students.
        as_zip: Whether to create a zip file for each student instead of a folder.
        language: The language of the tasks.

    Raises:
        CourseError: A folder or file already exists, or cannot be written.
    """
    places = [folder / (f"{each.key}.zip" if as_zip else each.key) for each in roster.students]
    if existing := [place.name for place in places if place.exists()]:
        raise CourseError(
            f"{folder} already contains {', '.join(existing[:5])}.",
            hint="Choose another folder: nothing is overwritten.",
        )
    for student, place in zip(roster.students, places, strict=True):
        if not as_zip:
            create_folder(place, student.variant, language)
            continue
        with temporary_folder("coframe-new-") as name:
            files = create_folder(Path(name, "lab"), student.variant, language)
            _write_zip(place, student.key, files)
    return places


def _write_zip(path: Path, folder: str, files: list[Path]) -> None:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in files:
            archive.write(file, f"{folder}/{file.name}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_complete(path, content.getvalue())
    except OSError as error:
        raise CourseError(f"Cannot write {path}: {error.strerror}.", hint="Choose another folder.") from None


def stub_texts(name: str) -> list[str]:
    """Return the text of a file of the lab, with the lab's own numbers, in each language."""
    return [_filled(name, assignment_of(None), Language(code)) for code in languages()]


def file_names() -> list[str]:
    """Return the names of the files of the lab."""
    return sorted(path.name.removesuffix(_SUFFIX) for path in _TEMPLATES.glob(f"*{_SUFFIX}"))


def _filled(name: str, assignment: Assignment, language: Language) -> str:
    """Return a file of the lab with the parameters of the assignment."""
    text = language.stub(name, (_TEMPLATES / f"{name}{_SUFFIX}").read_text(encoding="utf-8"))
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
        "VARIANT": language.text(
            "These are the numbers of the lab."
            if assignment.variant is None
            else f"These are the numbers of variant {assignment.variant}."
        ),
    }
    return re.sub(r"@([A-Z0-9_]+)@", lambda match: values[match[1]], text)


def _numbers(values: tuple[float, ...]) -> str:
    return "[" + ", ".join(f"{value:g}" for value in values) + "]"
