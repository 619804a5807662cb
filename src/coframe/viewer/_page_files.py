# SPDX-License-Identifier: Apache-2.0
"""The files of the built page. Wheels contain the scripts and the style sheet compressed (CMakeLists.txt)."""

from __future__ import annotations

import gzip
from pathlib import Path

__all__ = ["STATIC", "find", "read"]

STATIC = Path(__file__).resolve().parent / "static"


def find(file: Path) -> Path | None:
    """Return the file, or the compressed file `NAME.gz` instead, or None if neither exists."""
    for candidate in (file, file.with_name(f"{file.name}.gz")):
        if candidate.is_file():
            return candidate
    return None


def read(file: Path) -> bytes:
    """Return the contents of a file, which may be stored compressed.

    Raises:
        OSError: There is no such file, or it cannot be read.
    """
    found = find(file)
    if found is None:
        raise FileNotFoundError(file)
    return found.read_bytes() if found == file else gzip.decompress(found.read_bytes())
