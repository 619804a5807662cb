# SPDX-License-Identifier: Apache-2.0
"""Write files atomically: a full disk or Ctrl-C leaves no partial file, and an existing file is kept."""

from __future__ import annotations

import os
import sys
import time
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["complete_or_absent", "write_complete"]

_PATIENCE = 2.0  # seconds; virus scanners and other writers have a new file open for less
_POLL_PERIOD = 0.02


@contextmanager
def complete_or_absent(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield a temporary path to write to. The file is renamed to `path` only after everything has been written.

    Several threads and processes may write the same file: each one writes to its own temporary path, and the last one
    to finish determines the content. Devices and named pipes are written directly.

    Raises:
        OSError: The file cannot be written; `filename` is the name of the file itself.
    """
    path = Path(path)
    if path.exists() and not path.is_file():
        yield path
        return
    path = Path(os.path.realpath(path))  # A symbolic link is kept, even if it points to itself.
    part = path.with_name(f".{path.name}.{os.urandom(6).hex()}.part")
    try:
        yield part
        _replace(part, path)
    except OSError as error:
        if error.filename == str(part):
            error.filename, error.filename2 = str(path), None
        raise
    finally:
        _remove(part)


def write_complete(path: str | os.PathLike[str], content: bytes) -> None:
    """Write a file. If this fails, the previous content is kept.

    Raises:
        OSError: The file cannot be written.
    """
    with complete_or_absent(path) as part:
        part.write_bytes(content)


def _replace(part: Path, path: Path) -> None:
    """Rename a file. Windows refuses this while another program has the old file open: wait shortly for that."""
    deadline = time.monotonic() + _PATIENCE
    while True:
        try:
            part.replace(path)
        except PermissionError:
            if sys.platform != "win32" or time.monotonic() > deadline:
                raise
            time.sleep(_POLL_PERIOD)
        else:
            return


def _remove(path: Path) -> None:
    with suppress(OSError):  # On a read-only disk, this is an error even if there is no such file.
        path.unlink()
