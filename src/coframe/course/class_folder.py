# SPDX-License-Identifier: Apache-2.0
"""Find the submissions of a class: folders and zip files, also as Moodle and Canvas deliver them.

- Moodle: a folder ``Full Name_12345_assignsubmission_file_`` for each student, with files or a zip file in it.
- Canvas: files ``lastfirst_LATE_42_777_lab.zip`` for each student, with the numbers of the user and of the submission.
"""

from __future__ import annotations

import os
import re
import stat
import zipfile
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, NamedTuple

from coframe._files.regular_files import check_regular, open_regular, read_regular
from coframe.course.folders import file_names
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["MAX_ENTRIES", "MAX_EXTRACTED", "Submission", "find_lab_folder", "submissions"]

MAX_ENTRIES = 2_000  # files of a zip file
MAX_EXTRACTED = 50 << 20  # bytes of all files of a zip file
_MAX_ARCHIVE = 200 << 20  # bytes of a zip file
_MAX_FOLDERS = 200  # maximum number of files in a folder among which the files of the lab are searched
_CANVAS = re.compile(r"(?P<name>[^_]+)(?P<late>_LATE)?_(?P<user>\d+)_(?P<submission>\d+)_(?P<file>.+)", re.IGNORECASE)
_VERSION = re.compile(r"-(\d+)$")  # of a file that was handed in again with the same name
_MACOS = "__MACOSX"
_LINK = "{0} is a link to another folder. Links of submissions are not followed. Replace it with a copy of that folder."


class Submission(NamedTuple):
    """The submission of a student.

    Attributes:
        folder: The folder with the files of the lab.
        attempts: How often the student has handed it in; the last attempt counts.
        is_late: Whether Canvas has marked it as late.
        problem: Why it cannot be graded, or "".
    """

    folder: Path
    attempts: int = 1
    is_late: bool = False
    problem: str = ""


class _Attempt(NamedTuple):
    """Files that were handed in together; attempts are compared by their order."""

    order: tuple[int, int, str]
    paths: tuple[Path, ...]
    is_late: bool = False


def submissions(folder: Path, scratch: Path) -> dict[str, Submission]:
    """Return the submission of each student, by the name of its folder or file.

    A folder without files of the lab is also a submission. Hidden files, and those that macOS adds to archives, are
    not. A symbolic link is a submission that cannot be graded, because it may point to files of another user.

    Args:
        folder: The folder, or a zip file of it.
        scratch: An empty folder, into which zip files are extracted.

    Raises:
        CourseError: There is none.
    """
    extract = _Extraction(scratch)
    root = extract(folder) if folder.is_file() else folder
    entries = [path for path in _entries(root) if path.is_dir() or _is_archive(path) or _CANVAS.fullmatch(path.name)]
    if len(entries) == 1 and entries[0].is_dir() and not entries[0].is_symlink() and folder.is_file():
        root = entries[0]  # a zip file of a folder
        entries = [path for path in _entries(root) if path.is_dir() or _is_archive(path)]
    students: dict[str, list[_Attempt]] = {}
    for path in entries:
        name, attempt = _attempt_of(path)
        students.setdefault(name, []).append(attempt)
    if not students:
        raise CourseError(
            f"No submissions in {folder}.",
            hint="The folder must contain a folder or a zip file for each student, with the student's files.",
        )
    return {name: _submission(attempts, extract) for name, attempts in sorted(students.items())}


def _entries(folder: Path) -> list[Path]:
    """Return the files and folders in a folder, except hidden ones."""
    try:
        found = sorted(folder.iterdir())
    except OSError as error:
        raise CourseError(f"Cannot read {folder}: {error.strerror}.", hint="Give the folder of a class.") from None
    return [path for path in found if not path.name.startswith((".", "__"))]


def _is_archive(path: Path) -> bool:
    return path.suffix.lower() == ".zip" and path.is_file()


def _attempt_of(path: Path) -> tuple[str, _Attempt]:
    """Return the name of a student, and the attempt to which a file or folder belongs."""
    match = None if path.is_dir() else _CANVAS.fullmatch(path.name)
    if match is None:
        name = path.name if path.is_dir() else _VERSION.sub("", path.stem)
        return name, _Attempt((0, _version(path), path.name), (path,))
    order = int(match["submission"]), _version(Path(match["file"])), match["file"]
    return f"{match['name']}_{match['user']}", _Attempt(order, (path,), bool(match["late"]))


def _version(path: Path) -> int:
    found = _VERSION.search(path.stem)
    return int(found[1]) if found else 0


def _submission(attempts: list[_Attempt], extract: _Extraction) -> Submission:
    """Return the last attempt of a student as a submission."""
    attempts = _join_loose_files(attempts)
    last = max(attempts, key=lambda attempt: attempt.order)
    place = last.paths[0]
    if len(last.paths) == 1 and place.is_dir():
        return _of_folder(place, extract, len(attempts))
    try:
        folder = extract(*last.paths)
    except CourseError as error:
        return Submission(place, len(attempts), last.is_late, str(error))
    return Submission(find_lab_folder(folder), len(attempts), last.is_late)


def _join_loose_files(attempts: list[_Attempt]) -> list[_Attempt]:
    """Return the attempts, with loose files that Canvas delivers one by one joined to one attempt."""
    archives = [attempt for attempt in attempts if not attempt.order[0] or _is_archive(attempt.paths[0])]
    loose_files: dict[int, list[_Attempt]] = {}
    for attempt in attempts:
        if attempt not in archives:
            loose_files.setdefault(attempt.order[0], []).append(attempt)
    for number, files in loose_files.items():
        newest = sorted(files, key=lambda attempt: attempt.order)
        paths = tuple(path for attempt in newest for path in attempt.paths)
        archives.append(_Attempt((number, 0, ""), paths, any(attempt.is_late for attempt in files)))
    return archives


def _of_folder(student: Path, extract: _Extraction, attempts: int) -> Submission:
    """Return the submission in a folder, in which the files of the lab may be in a zip file."""
    if student.is_symlink():
        return Submission(student, attempts, problem=_LINK.format(student.name))
    found = find_lab_folder(student)
    archives = [path for path in _files_below(student) if _is_archive(path) and not path.is_symlink()]
    if _lab_files(found) or not archives:
        return Submission(found, attempts)
    newest = max(archives, key=lambda path: (_version(path), path.name))
    try:
        return Submission(find_lab_folder(extract(newest)), max(attempts, len(archives)))
    except CourseError as error:
        return Submission(student, attempts, problem=str(error))


def find_lab_folder(student: Path) -> Path:
    """Return the folder with the most lab files, at most two levels below the folder of a student.

    Links to folders are not followed, and links do not count as lab files.
    """
    candidates = [student, *_folders_in(student)]
    candidates += [below for folder in candidates[1:] for below in _folders_in(folder)]
    return max(candidates, key=_lab_files)


def _lab_files(folder: Path) -> int:
    return sum((folder / name).is_file() and not (folder / name).is_symlink() for name in file_names())


def _folders_in(folder: Path) -> list[Path]:
    """Return the folders in a folder of a student, without links; none if it cannot be read."""
    try:
        with os.scandir(folder) as entries:
            found = [entry.path for entry in entries if entry.is_dir(follow_symlinks=False)]
    except OSError:
        return []
    return [Path(path) for path in sorted(found)[:_MAX_FOLDERS] if Path(path).name != _MACOS]


def _files_below(student: Path) -> Iterator[Path]:
    for folder in (student, *_folders_in(student)):
        try:
            yield from (path for path in sorted(folder.iterdir())[:_MAX_FOLDERS] if path.is_file())
        except OSError:
            continue


class _Extraction:
    """Extracts zip files, which are untrusted: no links, no absolute paths, and limits on files and bytes."""

    def __init__(self, scratch: Path) -> None:
        self._scratch = scratch
        self._count = 0

    def __call__(self, *paths: Path) -> Path:
        """Extract a zip file, or copy files, into a new folder, and return it.

        Raises:
            CourseError: A file cannot be read, or exceeds a limit.
        """
        target = self._scratch / str(self._count)
        self._count += 1
        target.mkdir(parents=True)
        for path in paths:
            if _is_archive(path):
                _extract(path, target)
            else:
                self._copy(path, target)
        return target

    def _copy(self, path: Path, target: Path) -> None:
        match = _CANVAS.fullmatch(path.name)
        name = Path(match["file"]) if match else Path(path.name)
        plain_name = name.with_name(_VERSION.sub("", name.stem) + name.suffix)
        try:
            if path.is_symlink():
                raise CourseError(f"{path.name} is a link.", hint="Replace it with a file.")
            (target / plain_name).write_bytes(read_regular(path, MAX_EXTRACTED))
        except OSError as error:
            raise CourseError(f"{path.name} cannot be read: {error.strerror}.", hint="Replace the file.") from None


def _extract(path: Path, target: Path) -> None:
    try:
        check_regular(path, _MAX_ARCHIVE)
        with open_regular(path) as file, zipfile.ZipFile(file) as archive:
            entries = [each for each in archive.infolist() if _is_wanted(each)]
            if len(entries) > MAX_ENTRIES:
                raise CourseError(
                    f"{path.name} contains {len(entries)} files, more than the maximum of {MAX_ENTRIES}.",
                    hint="Extract it by hand.",
                )
            left = MAX_EXTRACTED
            for entry in entries:
                left -= _extract_entry(archive, entry, target, left, path.name)
    except (zipfile.BadZipFile, NotImplementedError, RuntimeError, EOFError, ValueError) as error:
        raise CourseError(f"{path.name} is not a zip file that can be read: {error}.", hint="Extract it.") from None
    except OSError as error:
        raise CourseError(f"{path.name} cannot be read: {error.strerror or error}.", hint="Extract it.") from None


def _is_wanted(entry: zipfile.ZipInfo) -> bool:
    """Return whether an entry is a regular file with a name inside the folder."""
    name = PurePosixPath(entry.filename.replace("\\", "/"))
    mode = entry.external_attr >> 16
    is_special = bool(mode) and stat.S_IFMT(mode) not in (0, stat.S_IFREG)
    is_outside = name.is_absolute() or ".." in name.parts or ":" in name.parts[0] if name.parts else True
    return not (entry.is_dir() or is_special or is_outside or _MACOS in name.parts)


def _extract_entry(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, target: Path, remaining: int, name: str) -> int:
    """Extract an entry, and return its number of bytes. The size in the archive may be wrong."""
    place = target.joinpath(*PurePosixPath(entry.filename.replace("\\", "/")).parts)
    place.parent.mkdir(parents=True, exist_ok=True)
    written = 0
    with archive.open(entry) as source, place.open("wb") as file:
        for block in iter(_reader(source.read), b""):
            written += len(block)
            if written > remaining:
                raise CourseError(
                    f"{name} contains more than the maximum of {MAX_EXTRACTED >> 20} MB.", hint="Extract it by hand."
                )
            file.write(block)
    return written


def _reader(read: Callable[[int], bytes]) -> Callable[[], bytes]:
    return lambda: read(1 << 16)
