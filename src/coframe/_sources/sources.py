# SPDX-License-Identifier: Apache-2.0
"""Source: a file that is not opened by a path. `as_source` makes one of everything that users pass as a recording.

A source has those attributes of a path that readers use, such as `name` and `suffix`. Its text is its URL without
passwords and signatures.
"""

from __future__ import annotations

import io
import os
import re
import shutil
import tempfile
import threading
from contextlib import ExitStack
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any, BinaryIO, Final, cast
from urllib.parse import quote, urlsplit

from coframe._files.regular_files import open_regular
from coframe._files.temporary_folders import temporary_folder
from coframe._sources._file_objects import DownloadedRanges, FileRanges, check_binary, is_local, name_of
from coframe._sources.block_cache import MAX_RANGE, BlockCache, RangedFile
from coframe._sources.remote_error import RemoteFileError
from coframe._sources.urls import HTTP, SCHEMES, STORES, base_name, remove_credentials, remove_signature, scheme_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe._sources._object_store import StoreRanges
    from coframe._sources.block_cache import ByteRanges

__all__ = ["MAX_DOWNLOAD", "Location", "Readable", "Source", "as_source", "file_size", "open_file"]

MAX_DOWNLOAD: Final = 64 << 30  # bytes of a file that is copied to this machine because it cannot be read in ranges
_MIN_FREE_SPACE: Final = 1 << 30  # bytes that a copy leaves free on the disk


class Source:
    """A file that is not opened by a path. Thread-safe.

    Attributes:
        name: The last part of its URL, or the name of the file object.
        is_remote: Whether it is on another machine, so that only what is needed is read.
        progress: Called while a whole file is copied to this machine, with the number of bytes so far and the total
            or 0.
    """

    is_remote = True

    def __init__(self, name: str) -> None:
        self.name = name
        self._lock = threading.Lock()
        self._process = os.getpid()
        self._cache: BlockCache | None = None
        self.progress: Callable[[int, int], object] = lambda _done, _total: None

    @property
    def suffix(self) -> str:
        """The suffix of the name, such as ``.mcap``."""
        return PurePosixPath(self.name).suffix

    @property
    def stem(self) -> str:
        """The name without the suffix."""
        return PurePosixPath(self.name).stem

    @property
    def size(self) -> int:
        """Its size in bytes.

        Raises:
            RemoteFileError: It cannot be read.
        """
        return self.cache.ranges.size

    @property
    def version(self) -> list[str]:
        """What changes when the file does, such as its ETag; empty if the server states nothing of the kind.

        Raises:
            RemoteFileError: It cannot be read.
        """
        return [part for part in self.cache.ranges.version if part]

    @property
    def identity(self) -> str:
        """A name that stays the same between sessions, even if the signature in the URL changes."""
        return str(self)

    @property
    def cache(self) -> BlockCache:
        """The blocks of the file that have been read; the file is opened when they are first needed.

        Raises:
            RemoteFileError: It cannot be read.
        """
        with self._lock:
            if self._process != os.getpid():  # A child process does not share the connections of its parent.
                self._cache, self._process = None, os.getpid()
            if self._cache is None:
                self._cache = BlockCache(self._connect())
            return self._cache

    def stream(self) -> BinaryIO:
        """Return a file object for reading, at the first byte.

        Raises:
            RemoteFileError: It cannot be read.
        """
        return cast("BinaryIO", io.BufferedReader(RangedFile(self.cache)))

    def read(self, offset: int, size: int) -> bytes:
        """Return bytes of the file; fewer at its end.

        Raises:
            RemoteFileError: They cannot be read.
        """
        return self.cache.read(offset, size)

    def is_folder(self) -> bool:
        """Return whether the source is a folder with files, which has no bytes itself."""
        return False

    def inner(self, name: str) -> Source:
        """Return a file of a folder, or a file next to this one."""
        raise NotImplementedError

    def names(self) -> list[str] | None:
        """Return the names of the files in a folder, or None if the server does not list them."""
        return None

    def copy(self, closing: ExitStack) -> Path:
        """Copy the file to a temporary folder, for readers that need a path.

        Args:
            closing: Receives the deletion of the copy.

        Raises:
            RemoteFileError: It cannot be read completely, or is too large.
        """
        folder = Path(closing.enter_context(temporary_folder("coframe-download-")))
        target = folder / (PurePosixPath(self.name).name or "file")
        size = self.size
        limit = max_download(folder)
        if size > limit:
            reason = f"this format is read from a copy, and {size} bytes are more than the maximum of {limit}"
            raise RemoteFileError.because(str(self), reason, "Convert it to MCAP, which is read in parts.")
        with target.open("wb") as copy:
            for offset in range(0, size, MAX_RANGE):
                copy.write(self.cache.read_once(offset, MAX_RANGE))
                self.progress(min(offset + MAX_RANGE, size), size)
        return target

    def close(self) -> None:
        """Close connections and discard cached data. Reading opens the file again."""
        with self._lock:
            if self._cache is not None and self._process == os.getpid():
                self._cache.close()
            self._cache = None

    def _connect(self) -> ByteRanges:
        raise NotImplementedError


class _Memory(Source):
    """Bytes."""

    is_remote = False

    def __init__(self, data: bytes) -> None:
        super().__init__("bytes")
        self._data = data

    def stream(self) -> BinaryIO:
        return io.BytesIO(self._data)

    @property
    def size(self) -> int:
        return len(self._data)

    def read(self, offset: int, size: int) -> bytes:
        return self._data[offset : offset + size]

    def _connect(self) -> ByteRanges:
        return FileRanges(io.BytesIO(self._data), self.name)

    def __str__(self) -> str:
        return f"bytes ({len(self._data)})"

    def __reduce__(self) -> tuple[object, ...]:
        return _Memory, (self._data,)


class _FileObject(Source):
    """A file object that can seek."""

    def __init__(self, file: BinaryIO) -> None:
        self._text = remove_credentials(name_of(file))
        super().__init__(base_name(self._text) or self._text)
        self._file = file
        self.is_remote = not is_local(file)

    def _connect(self) -> ByteRanges:
        return FileRanges(self._file, self._text)

    def __str__(self) -> str:
        return self._text

    def __reduce__(self) -> tuple[object, ...]:
        raise RemoteFileError.because(
            self._text, "a file object cannot be opened by another process", "Open the recording by its path or URL."
        )


class _Url(Source):
    """A file on a server."""

    def __init__(self, url: str) -> None:
        self._url = url.strip()
        super().__init__(base_name(url))

    def inner(self, name: str) -> Source:
        """Return a file of a folder, or a file next to this one."""
        address, mark, query = self._url.partition("?")
        folder = address.rstrip("/") if self.is_folder() else address.rpartition("/")[0]
        return type(self)(f"{folder}/{name}{mark}{query}")

    def __str__(self) -> str:
        return remove_credentials(self._url)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self)!r})"

    @property
    def identity(self) -> str:
        """The URL without signatures; it contains other parameters, and must not be shown."""
        return remove_signature(self._url)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Url) and other._url == self._url

    def __hash__(self) -> int:
        return hash(self._url)

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self._url,)


class _Http(_Url):
    """A file on a web server."""

    def inner(self, name: str) -> Source:
        """Return a file of a folder, or a file next to this one."""
        return super().inner(quote(name))

    def is_folder(self) -> bool:
        """Return whether the path of the URL ends with a slash, because servers do not mark folders."""
        return re.split("[?#]", self._url)[0].endswith("/")

    def _connect(self) -> ByteRanges:
        from coframe._sources._http import HttpRanges  # noqa: PLC0415 - paths do not need sockets and TLS

        ranges = HttpRanges(self._url)
        if ranges.is_ranged:
            return ranges
        download = cast("BinaryIO", tempfile.TemporaryFile())  # noqa: SIM115 - `close` closes it
        with ExitStack() as on_error:
            on_error.callback(download.close)
            ranges.download(download.write, max_download(tempfile.gettempdir()), self.progress)
            on_error.pop_all()
        self.is_remote = False
        return DownloadedRanges(download, ranges.name, ranges.version)


class _Store(_Url):
    """A file in an object store."""

    def is_folder(self) -> bool:
        """Return whether it is a folder."""
        return cast("StoreRanges", self.cache.ranges).is_folder

    def names(self) -> list[str] | None:
        """Return the names of the files in the folder."""
        from coframe._sources._object_store import StoreFolder  # noqa: PLC0415 - as above

        return StoreFolder(self._url).list()

    def _connect(self) -> ByteRanges:
        from coframe._sources._object_store import StoreRanges  # noqa: PLC0415 - as above

        return StoreRanges(self._url)


Readable = Path | Source
"""What readers of files accept: a path, or a source."""


Location = str | os.PathLike[str] | Source
"""How a file is named: by its path, its URL, or a source."""


def as_source(value: Any) -> Readable:
    """Return the path or the source that a user means.

    Args:
        value: A path, a URL, bytes, or a file object for bytes. ``file:`` URLs are paths.

    Raises:
        RemoteFileError: The scheme of the URL is not known, or a file object cannot be read.
        TypeError: It is none of these.
    """
    if isinstance(value, Path | Source):
        return value
    if isinstance(value, str):
        return _parse_location(value)
    if isinstance(value, os.PathLike):
        path = os.fspath(value)
        return Path(os.fsdecode(path))
    if isinstance(value, bytes | bytearray | memoryview):
        return _Memory(bytes(value))
    check_binary(value)
    return _FileObject(value) if _can_seek(value) else _Memory(_read_all(value))


def _parse_location(text: str) -> Readable:
    scheme = scheme_of(text)
    if not scheme:
        return Path(text)
    if scheme == "file":
        from urllib.request import url2pathname  # noqa: PLC0415 - as above

        return Path(url2pathname(urlsplit(text.strip()).path))
    if scheme in HTTP:
        return _Http(text)
    if scheme in STORES:
        return _Store(text)
    known = ", ".join(f"{each}://" for each in SCHEMES)
    raise RemoteFileError.because(
        remove_credentials(text), f"URLs of the kind {scheme[:20]}:// are not supported", f"Known: {known}."
    )


def _can_seek(file: Any) -> bool:
    try:
        return bool(file.seekable())
    except Exception:  # noqa: BLE001 - any class can be a file object
        return False


_MAX_STREAM: Final = 1 << 30  # bytes


def _read_all(file: Any) -> bytes:
    """Return the bytes of a stream that cannot seek, such as a pipe."""
    name, parts, size = name_of(file), list[bytes](), 0
    try:
        while part := file.read(1 << 20):
            parts.append(part)
            size += len(part)
            if size > _MAX_STREAM:
                break
    except Exception as error:  # noqa: BLE001 - as above
        raise RemoteFileError.because(name, " ".join((str(error) or type(error).__name__).split())[:200]) from None
    if size > _MAX_STREAM:
        reason = f"it cannot seek, and has more than the maximum of {_MAX_STREAM >> 20} MiB"
        raise RemoteFileError.because(name, reason, "Write it to a file first.")
    return b"".join(parts)


def max_download(folder: str | Path) -> int:
    """Return the maximum size of a copy in a folder, in bytes."""
    return max(min(MAX_DOWNLOAD, shutil.disk_usage(folder).free - _MIN_FREE_SPACE), 0)


def open_file(file: Readable) -> BinaryIO:
    """Open a path or a source for reading.

    Raises:
        OSError: It cannot be read; UnsuitableFileError if it is not a regular file.
    """
    return file.stream() if isinstance(file, Source) else open_regular(file)


def file_size(file: Readable) -> int:
    """Return the size of a file in bytes.

    Raises:
        OSError: It cannot be read.
    """
    return file.size if isinstance(file, Source) else file.stat().st_size
