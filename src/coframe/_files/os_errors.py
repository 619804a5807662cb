# SPDX-License-Identifier: Apache-2.0
"""Messages of operating system errors, without their numbers."""

from __future__ import annotations

__all__ = ["explain", "reason"]


def reason(error: BaseException) -> str:
    """Return why something failed, for a text that names the file: "No such file or directory"."""
    return (isinstance(error, OSError) and error.strerror) or str(error) or type(error).__name__


def explain(error: BaseException) -> str:
    """Return the text of an error with the files that it is about: "run.mcap: No such file or directory"."""
    if not isinstance(error, OSError):
        return reason(error)
    if type(error).__str__ is not OSError.__str__:  # Its text has the file and no number.
        return str(error)
    names = [str(name) for name in (error.filename, error.filename2) if name is not None]
    return ": ".join([*names, reason(error)])
