# SPDX-License-Identifier: Apache-2.0
"""Read untrusted files safely: check that the file is regular, open it, and read only up to a limit.

A path can also name a pipe, which blocks on opening until there is a writer, a device such as ``/dev/zero``, which
never ends, or a socket; a link can point to any of them. A regular file can be sparse: a terabyte that takes an hour to
read although the disk stores one page.

The path is checked first, because opening can have side effects: it can start a watchdog, or unblock the writer of a
pipe. The open file is checked again, because the path can change in between.
"""

from __future__ import annotations

import errno
import os
import stat
from typing import TYPE_CHECKING, BinaryIO, Final

from coframe._base_error import CoframeError

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["UnsuitableFileError", "check_regular", "open_regular", "read_regular", "read_regular_text", "reading_hint"]

# Without O_NONBLOCK, opening a named pipe would wait for a writer. It changes nothing for regular files.
_FLAGS: Final = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
_KINDS: Final[tuple[tuple[Callable[[int], bool], str], ...]] = (
    (stat.S_ISDIR, "the path is a folder, not a file"),
    (stat.S_ISFIFO, "the path is a named pipe, not a regular file; write its content to a file first"),
    (stat.S_ISSOCK, "the path is a socket, not a regular file"),
    (stat.S_ISCHR, "the path is a device, not a regular file"),
    (stat.S_ISBLK, "the path is a device, not a regular file"),
)
# Sparse files below this size are accepted, and larger ones if the stored part is plausible for a compressing file
# system.
MAX_SPARSE: Final = 64 << 20  # bytes
MAX_SPARSE_RATIO: Final = 1000  # ratio of the size to the bytes on the disk
_BLOCK: Final = 512  # bytes, the unit of st_blocks
_MIN_STORED: Final = 8 * _BLOCK  # some file systems report nothing or one block for files that they store elsewhere
_UNNAMED_PIPES: Final = ("/dev/", "/proc/")  # a shell passes the output of a program as /dev/fd/63 or /dev/stdin


class UnsuitableFileError(CoframeError, OSError, ValueError):
    """A file that is not regular or is larger than the limit; ``strerror`` gives the reason."""

    def __str__(self) -> str:
        return f"{self.filename} cannot be read: {self.strerror}"


def open_regular(path: str | os.PathLike[str]) -> BinaryIO:
    """Open a regular file for reading.

    Args:
        path: The file, or a link to it.

    Raises:
        UnsuitableFileError: It is not a regular file, it is sparse, or the path is not valid.
        OSError: There is no such file, or it cannot be read.
    """
    try:
        _check(os.stat(path), path)  # noqa: PTH116 - a path of any kind
        return open(path, "rb", opener=_open)  # pathlib has no opener
    except OSError:
        raise
    except ValueError:  # a NUL, or a character that file names cannot have
        raise UnsuitableFileError(errno.EINVAL, "the name of the file is not valid", os.fspath(path)) from None


def read_regular(path: str | os.PathLike[str], max_bytes: int) -> bytes:
    """Return the content of a regular file.

    Args:
        path: The file, or a link to it.
        max_bytes: The maximum size.

    Raises:
        UnsuitableFileError: It is not a regular file, or is larger than `max_bytes`.
        OSError: The file cannot be read.
    """
    with open_regular(path) as file:
        try:
            content = file.read(max_bytes + 1)
        except OSError as error:
            error.filename = os.fspath(path)
            raise
    if content is None:  # kernel files, which block until there is an event
        raise UnsuitableFileError(errno.EAGAIN, "the file has no content yet", os.fspath(path))
    if len(content) > max_bytes:
        raise _too_large(path, max_bytes)
    return content


def read_regular_text(path: str | os.PathLike[str], max_bytes: int, encoding: str = "utf-8") -> str:
    r"""Return the text of a regular file. Line endings may also be ``\r\n``.

    Args:
        path: The file, or a link to it.
        max_bytes: The maximum size.
        encoding: The encoding of the text, such as "utf-8" or "ascii".

    Raises:
        UnsuitableFileError: It is not a regular file, or is larger than `max_bytes`.
        OSError: The file cannot be read.
        UnicodeDecodeError: It is not text in this encoding.
    """
    return read_regular(path, max_bytes).decode(encoding).replace("\r\n", "\n").replace("\r", "\n")


def check_regular(path: str | os.PathLike[str], max_bytes: int | None = None) -> None:
    """Raise OSError if this file must not be passed to a library that opens files by name.

    Args:
        path: The file, or a link to it.
        max_bytes: The maximum size, or None for a library that does not read the whole file.

    Raises:
        UnsuitableFileError: It is not a regular file, or is larger than `max_bytes`.
        OSError: The file cannot be read.
    """
    with open_regular(path) as file:
        if max_bytes is not None and os.fstat(file.fileno()).st_size > max_bytes:
            raise _too_large(path, max_bytes)


def reading_hint(error: OSError) -> str:
    """Return a hint for a file that cannot be read, or "" if the error message already contains it."""
    return "" if isinstance(error, UnsuitableFileError) else "Check the path and the permission to read it."


def _too_large(path: str | os.PathLike[str], max_bytes: int) -> UnsuitableFileError:
    limit = f"{max_bytes >> 20} MiB" if max_bytes >= 1 << 20 else f"{max_bytes} bytes"
    return UnsuitableFileError(errno.EFBIG, f"the file is larger than the maximum of {limit}", os.fspath(path))


def _open(path: str, _flags: int) -> int:
    descriptor = os.open(path, _FLAGS)
    try:
        _check(os.fstat(descriptor), path)
    except BaseException:
        os.close(descriptor)
        raise
    return descriptor


def _check(status: os.stat_result, path: str | os.PathLike[str]) -> None:
    if not stat.S_ISREG(status.st_mode):
        kind = next((text for has, text in _KINDS if has(status.st_mode)), "the path is not a regular file")
        if os.fspath(path).startswith(_UNNAMED_PIPES):
            kind = kind.replace("named pipe", "pipe")
        raise UnsuitableFileError(errno.EINVAL, kind, os.fspath(path))
    stored = getattr(status, "st_blocks", 0) * _BLOCK
    if stored >= _MIN_STORED and status.st_size > max(MAX_SPARSE, MAX_SPARSE_RATIO * stored):
        reason = f"the file is sparse: the disk stores only {stored} of its {status.st_size} bytes"
        raise UnsuitableFileError(errno.EFBIG, reason, os.fspath(path))
