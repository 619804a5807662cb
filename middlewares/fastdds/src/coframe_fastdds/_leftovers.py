# SPDX-License-Identifier: Apache-2.0
"""Files in shared memory that killed processes have left. Fast DDS does not remove them."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Final

FOLDER: Final = Path("/dev/shm")  # noqa: S108 - where Fast DDS puts its files on Linux

# A process holds an exclusive lock of this file as long as it uses the segment or port of the same name.
_LOCK: Final = re.compile(r"(fast(?:dds|rtps)_(?:[0-9a-f]{16}|port\d{1,5}))_el")
_BLOCK: Final = 512  # bytes, of os.stat_result.st_blocks
_MIB: Final = 1 << 20


def leftovers(folder: Path = FOLDER) -> tuple[int, int]:
    """Return the number of files whose processes have ended, and the bytes of memory that they take."""
    number = size = 0
    for path in sorted(folder.glob("fast*_el")) if folder.is_dir() else ():
        found = _LOCK.fullmatch(path.name)
        if found is None or not _is_abandoned(path):
            continue
        for each in (path, folder / found[1], folder / f"sem.{found[1]}_mutex"):
            try:
                status = each.stat()
            except OSError:
                continue
            number, size = number + 1, size + status.st_blocks * _BLOCK
    return number, size


def line(folder: Path = FOLDER) -> str:
    """Return what is said about such files, or "" if there are none."""
    number, size = leftovers(folder)
    if number == 0:
        return ""
    files = "1 file" if number == 1 else f"{number} files"
    return (
        f"{files} of Fast DDS in {folder} ({size / _MIB:.1f} MiB) were left by processes that were killed; "
        "`fastdds shm clean` removes them"
    )


def _is_abandoned(path: Path) -> bool:
    import fcntl  # noqa: PLC0415 - not on Windows

    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return False  # of another user, or removed in the meantime
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except OSError:
        return False
    else:
        return True
    finally:
        os.close(descriptor)
