# SPDX-License-Identifier: Apache-2.0
"""Access files of a submission safely: only regular files inside its folder."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Final

from coframe._files.regular_files import check_regular, read_regular
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["MAX_BYTES", "MISSING_FILE", "check_outputs", "check_submitted", "is_submitted", "read_submitted"]

MISSING_FILE = "There is no file"  # the beginning of the problem of a criterion whose file was not submitted

MAX_BYTES: Final = 1 << 20  # many times the largest file of the lab
_MAX_LISTED = 10_000  # maximum number of files examined for hard links


def is_submitted(folder: Path, name: str) -> bool:
    """Return whether a folder contains an entry with this name; `check_submitted` then examines it."""
    return os.path.lexists(folder / name)


def check_submitted(file: Path) -> Path:
    """Check that a file belongs to a submission, and return its resolved path.

    Raises:
        CourseError: It is not a regular file; it is a link to a file outside its folder; it has a hard link outside its
            folder, so it may belong to another user; or it is too large.
    """
    folder = file.parent.resolve()
    real = Path(os.path.realpath(file))  # does not raise for a loop of links, which cannot be opened
    if not real.is_relative_to(folder):
        raise CourseError(
            f"{file.name} is a link to a file outside the folder.", hint="Replace the link with that file."
        )
    try:
        check_regular(real, MAX_BYTES)
        status = real.stat()
    except OSError as error:
        raise CourseError(f"{file.name} cannot be read: {error.strerror}.", hint="Replace it with a file.") from None
    if status.st_nlink > 1 and status.st_nlink > _count_hard_links(folder, status):
        raise CourseError(
            f"{file.name} is a hard link: another name of the same file is outside the folder, so the file may "
            "belong to another user.",
            hint="Replace the link with a copy.",
        )
    return real


def check_outputs(paths: Iterable[Path | None], folder: Path) -> None:
    """Check that a file to be written in a student's folder, such as a report, is not a link to the outside.

    Raises:
        CourseError: It is such a link.
    """
    real = folder.resolve()
    for path in filter(None, paths):
        written = Path(os.path.normpath(path.absolute()))
        is_inside = written.is_relative_to(real) or written.is_relative_to(os.path.normpath(folder.absolute()))
        if is_inside and not Path(os.path.realpath(path)).is_relative_to(real):
            raise CourseError(f"{path} is a link to a path outside the student's folder.", hint="Remove the link.")


def read_submitted(file: Path) -> str:
    """Return the text of a submitted file.

    Raises:
        CourseError: The file is not accepted; see `check_submitted`.
        OSError: It cannot be read.
    """
    return read_regular(check_submitted(file), MAX_BYTES).decode("utf-8", errors="replace")


def _count_hard_links(folder: Path, status: os.stat_result) -> int:
    """Return the number of hard links of a file in and below a folder."""
    count = listed = 0
    for path, _, names in os.walk(folder):
        for name in names:
            listed += 1
            if listed > _MAX_LISTED:
                return count
            try:
                other = os.lstat(os.path.join(path, name))  # noqa: PTH118 - fast, for many files
            except OSError:
                continue
            count += (other.st_dev, other.st_ino) == (status.st_dev, status.st_ino)
    return count
