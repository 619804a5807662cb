# SPDX-License-Identifier: Apache-2.0
"""Handle encodings of arguments and standard output, closed streams, closed pipes and full disks."""

from __future__ import annotations

import codecs
import io
import os
import sys

__all__ = ["accept_any_encoding", "discard_output", "flush_output", "is_undecodable", "replace_closed_streams"]

_HANDLER = "coframe.plain"
# Characters in trees and text with single-character replacements, so that columns stay aligned.
_ASCII_REPLACEMENTS = {"─": "-", "│": "|", "├": "+", "└": "`", "…": ".", "×": "x", "–": "-", "—": "-", "·": "."}  # noqa: RUF001


def accept_any_encoding() -> None:
    """Let standard output and standard error replace characters that their encoding does not support.

    Branches of trees are then drawn with ASCII characters; other characters are escaped. Windows uses such encodings
    for redirected output, other systems where a locale or PYTHONIOENCODING says so.
    """
    codecs.register_error(_HANDLER, _replace_characters)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper) and not stream.encoding.lower().startswith("utf"):
            stream.reconfigure(errors=_HANDLER)


def replace_closed_streams() -> None:
    """Redirect closed standard streams to the null device.

    Python represents them by None. Their file descriptors are free, so that the next file or socket would get one of
    them, and would receive what native code and child processes print.
    """
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        if getattr(sys, name) is None:
            null = os.open(os.devnull, os.O_RDWR)
            if null == number:
                os.set_inheritable(null, True)
            setattr(sys, name, os.fdopen(null, "w" if number else "r", encoding="utf-8"))


def is_undecodable(word: str) -> bool:
    """Return whether an argument contains invalid UTF-8 and is not the path of an existing file or folder.

    Python represents these bytes by lone surrogates. The names of frames, topics and new files cannot contain them.
    """
    try:
        word.encode()
    except UnicodeEncodeError:
        path = word.partition("=")[2] if word.startswith("--") else word
        folder, name = os.path.split(path)
        return not (os.path.lexists(path) or (os.path.lexists(folder) and not is_undecodable(name)))
    return False


def flush_output() -> None:
    """Flush standard output, because Python would report an error at exit as a traceback.

    Raises:
        OSError: The disk is full, or the reader of a pipe, such as ``head``, closed it.
    """
    if sys.stdout is not None and not sys.stdout.closed:
        sys.stdout.flush()


def discard_output() -> None:
    """Discard buffered output that could not be written, so that Python does not try again at exit."""
    null = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(null, sys.stdout.fileno())
    except (OSError, ValueError):  # It is not a file, or it is closed.
        pass
    finally:
        os.close(null)


def _replace_characters(error: UnicodeError) -> tuple[str | bytes, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    missing = error.object[error.start : error.end]
    return "".join(
        _ASCII_REPLACEMENTS.get(each) or each.encode("ascii", "backslashreplace").decode() for each in missing
    ), error.end
