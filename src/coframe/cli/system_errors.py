# SPDX-License-Identifier: Apache-2.0
"""Advice about operating system errors."""

from __future__ import annotations

import errno

from coframe._files.os_errors import reason

__all__ = ["description", "writing_advice"]

_DISK_FULL_CODES = {errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC)}
_ADVICE = {
    errno.EACCES: "Check the permissions.",
    errno.EPERM: "Check the permissions.",
    errno.EROFS: "Choose a writable folder.",
    errno.EMFILE: "Close files or raise the limit of open files: ulimit -n 4096.",
    **dict.fromkeys(_DISK_FULL_CODES, "Free some space, or write to another disk."),
}


def writing_advice(error: OSError) -> str:
    """Return what to do if a file could not be written."""
    return _ADVICE[errno.ENOSPC] if error.errno in _DISK_FULL_CODES else "Check that the folder exists and is writable."


def description(error: OSError) -> str:
    """Return a description of an unexpected error, with advice on a second line if available."""
    file = f"{error.filename}: " if error.filename else ""
    advice = _ADVICE.get(error.errno or 0, "")
    if "temporary directory" in str(error):  # the message of tempfile and of packages that use it
        advice = "Set TMPDIR to a folder with write permission."
    return f"coframe: {file}{reason(error)}" + (f"\n  {advice}" if advice else "")
