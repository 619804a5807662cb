# SPDX-License-Identifier: Apache-2.0
"""Temporary folders that do not stay behind: what a killed process left is removed by the next one."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

__all__ = ["temporary_folder"]


def temporary_folder(prefix: str) -> tempfile.TemporaryDirectory[str]:
    """Create a temporary folder, and remove those with the same prefix whose processes have ended.

    The name contains the ID of this process. The caller removes the folder with `cleanup` or a `with` block.

    Args:
        prefix: The begin of the name, for one purpose only: "coframe-lab-".
    """
    _remove_stale_folders(prefix)
    return tempfile.TemporaryDirectory(prefix=f"{prefix}{os.getpid()}-", ignore_cleanup_errors=True)


def _remove_stale_folders(prefix: str) -> None:
    for folder in Path(tempfile.gettempdir()).glob(f"{prefix}*-*"):
        number = folder.name.removeprefix(prefix).partition("-")[0]
        if number.isdecimal() and not _is_running(int(number)):
            shutil.rmtree(folder, ignore_errors=True)


def _is_running(process: int) -> bool:
    if os.name != "posix":  # On Windows, os.kill() with the signal 0 ends the process.
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        return True
    return True
