# SPDX-License-Identifier: Apache-2.0
"""Temporary folders that do not accumulate: the next process removes those left by killed processes."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from contextlib import ExitStack, suppress
from pathlib import Path

if sys.platform != "win32":
    import fcntl

__all__ = ["temporary_folder"]

_LOCK = ".lock"
_NEW_LOCK_PREFIX = ".lock-new"  # prefix of its name until it is locked


def temporary_folder(prefix: str) -> tempfile.TemporaryDirectory[str]:
    """Create a temporary folder, and remove those with the same prefix whose processes have ended.

    The folder contains a file ``.lock``. The caller removes the folder with `cleanup` or a `with` block.

    Args:
        prefix: The beginning of the name, unique to one purpose, such as "coframe-lab-".
    """
    _remove_stale_folders(prefix)
    return _LockedFolder(prefix)


class _LockedFolder(tempfile.TemporaryDirectory[str]):
    """A temporary folder with a locked file. The system releases the lock when the process ends, even if it is killed.

    A process ID would not suffice, because containers can share a temporary folder but number their processes
    independently.
    """

    def __init__(self, prefix: str) -> None:
        super().__init__(prefix=prefix, ignore_cleanup_errors=True)
        self._lock_release = ExitStack()
        if sys.platform == "win32":  # A killed process leaves its folder behind.
            return
        new = Path(self.name, _NEW_LOCK_PREFIX)
        with suppress(OSError):  # The file system has no locks: the folder is left behind as well.
            descriptor = os.open(new, os.O_RDWR | os.O_CREAT, 0o600)
            self._lock_release.callback(os.close, descriptor)
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            new.rename(new.with_name(_LOCK))

    def cleanup(self) -> None:
        """Remove the folder."""
        self._lock_release.close()
        super().cleanup()


def _remove_stale_folders(prefix: str) -> None:
    if sys.platform == "win32":
        return
    for folder in Path(tempfile.gettempdir()).glob(f"{prefix}*"):
        # The lock of a running process cannot be acquired. Other users can create such names, too: a link is not
        # followed, and a pipe does not block.
        with suppress(OSError), ExitStack() as closing:
            descriptor = os.open(folder / _LOCK, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
            closing.callback(os.close, descriptor)
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(folder, ignore_errors=True)
