# SPDX-License-Identifier: Apache-2.0
"""File objects of the caller, as files that are read in ranges."""

from __future__ import annotations

import errno
import io
from typing import Any, BinaryIO, Final, cast

from coframe._sources.remote_error import RemoteFileError

__all__ = ["DownloadedRanges", "FileRanges", "check_binary", "is_local", "name_of"]

_MAX_NAME: Final = 200


class FileRanges:
    """A file object that can seek; see :class:`coframe._sources.block_cache.ByteRanges`. It is not closed.

    Attributes:
        name: Its name in error messages.
        size: Its size in bytes.
    """

    def __init__(self, file: BinaryIO, name: str, version: tuple[str, ...] = ()) -> None:
        self.name = name
        self.version = version
        self._file = file
        try:
            self.size = file.seek(0, io.SEEK_END)
        except Exception as error:  # noqa: BLE001 - any class can be a file object
            raise _failure(name, error) from None

    def read_range(self, start: int, end: int) -> bytes:
        """Return the bytes from ``start`` to ``end``."""
        parts: list[bytes] = []
        try:
            self._file.seek(start)
            while start < end and (part := self._file.read(end - start)):
                parts.append(part)
                start += len(part)
            return b"".join(parts)
        except Exception as error:  # noqa: BLE001 - see above
            raise _failure(self.name, error) from None

    def close(self) -> None:
        """Do nothing: the caller closes the file object."""


class DownloadedRanges(FileRanges):
    """A temporary file with the complete content that a server sent."""

    def close(self) -> None:
        """Delete the temporary file."""
        self._file.close()


def name_of(file: Any) -> str:
    """Return the name of a file object; "file object" if it has none."""
    for attribute in ("full_name", "name", "path"):
        name = getattr(file, attribute, None)
        if isinstance(name, str) and name:
            return "".join(each if each.isprintable() else "_" for each in name)[-_MAX_NAME:]
    return "file object"


def is_local(file: Any) -> bool:
    """Return whether the bytes of a file object are on this machine, so that reading all of them is fast."""
    if isinstance(file, io.BytesIO):
        return True
    try:
        return isinstance(file.fileno(), int)
    except Exception:  # noqa: BLE001 - as in FileRanges
        return False


def check_binary(file: Any) -> None:
    """Raise an error if an object is not a file object for bytes.

    Raises:
        TypeError: It is of another type, or a file object for text.
    """
    if not callable(getattr(file, "read", None)):
        raise TypeError(f"expected a path, a URL, bytes or a file object, not {type(file).__name__}")
    if isinstance(file, io.TextIOBase) or isinstance(cast("Any", file).read(0), str):
        raise TypeError(f"the file object {name_of(file)} returns text: open it with the mode 'rb'")


def _failure(name: str, error: Exception) -> RemoteFileError:
    reason = " ".join((str(error) or type(error).__name__).split())[:200]
    return RemoteFileError.because(name, reason, number=getattr(error, "errno", None) or errno.EIO)
