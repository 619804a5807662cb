# SPDX-License-Identifier: Apache-2.0
"""Files of a submission that the grader itself reads: small regular files inside the folder only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from coframe.errors import CourseError

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["MAX_BYTES", "check_submitted", "read_submitted"]

MAX_BYTES: Final = 1 << 20  # many times the largest file of the lab


def check_submitted(file: Path) -> None:
    """Check that the grader can read a file of a submission.

    Raises:
        CourseError: It is not a regular file, is too large, or is a link to a file outside its folder.
    """
    if not file.is_file():
        raise CourseError(f"{file.name} is not a regular file.", hint="Replace it with a file.")
    if not file.resolve().is_relative_to(file.parent.resolve()):
        raise CourseError(f"{file.name} is a link to a file outside the folder.", hint="Replace it with that file.")
    size = file.stat().st_size
    if size > MAX_BYTES:
        raise CourseError(f"{file.name} has {size} bytes. The limit is {MAX_BYTES} bytes.", hint="Use a smaller file.")


def read_submitted(file: Path) -> str:
    """Return the text of a file of a submission.

    Raises:
        CourseError: The grader does not read it, see `check_submitted`.
        OSError: It cannot be read.
    """
    check_submitted(file)
    return file.read_text(encoding="utf-8", errors="replace")
