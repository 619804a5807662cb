# SPDX-License-Identifier: Apache-2.0
"""Files from outside, by one rule: open, check that it is a regular file, and read at most a limit.

A path can name something else: a named pipe, whose opening waits for a writer; a device such as ``/dev/zero``, which
never ends; a socket. A link can lead to each of them, and the size of a sparse file says nothing about its content. The
open file is checked, because a path can change between a check and the opening.
"""

from __future__ import annotations

import errno
import os
import stat
from typing import TYPE_CHECKING, BinaryIO, Final

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["check_regular", "open_regular", "read_regular"]

# Without O_NONBLOCK, opening a named pipe would wait for a writer. It changes nothing for regular files.
_FLAGS: Final = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
_KINDS: Final[tuple[tuple[Callable[[int], bool], str], ...]] = (
    (stat.S_ISFIFO, "a named pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


def open_regular(path: str | os.PathLike[str]) -> BinaryIO:
    """Open a regular file for reading.

    Args:
        path: The file, or a link to it.

    Raises:
        OSError: There is no such file, it cannot be read, or it is not a regular file; the text says what it is.
    """
    return open(path, "rb", opener=_open)  # noqa: PTH123, SIM115 - pathlib has no opener, and the caller closes it


def read_regular(path: str | os.PathLike[str], max_bytes: int) -> bytes:
    """Return the content of a regular file.

    Args:
        path: The file, or a link to it.
        max_bytes: The largest size that is read.

    Raises:
        OSError: The file cannot be read, is not a regular file, or is larger than `max_bytes`.
    """
    with open_regular(path) as file:
        content = file.read(max_bytes + 1)
    if len(content) > max_bytes:
        raise OSError(errno.EFBIG, f"larger than {max_bytes} bytes", os.fspath(path))
    return content


def check_regular(path: str | os.PathLike[str]) -> None:
    """Raise OSError if a library that opens files by their names could not read a regular file there.

    Raises:
        OSError: As for :func:`open_regular`.
    """
    open_regular(path).close()


def _open(path: str, _flags: int) -> int:
    descriptor = os.open(path, _FLAGS)
    try:
        mode = os.fstat(descriptor).st_mode
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), path)
        if not stat.S_ISREG(mode):
            kind = next((name for has, name in _KINDS if has(mode)), "something else")
            raise OSError(errno.EINVAL, f"{kind}, not a regular file", path)
    except BaseException:
        os.close(descriptor)
        raise
    return descriptor
