# SPDX-License-Identifier: Apache-2.0
"""Files in object stores (S3, Google Cloud Storage, Azure), read in ranges through fsspec."""

from __future__ import annotations

import errno
import importlib
import time
from typing import TYPE_CHECKING, Any, Final, NoReturn

from coframe._process.optional_imports import pip_install
from coframe._sources.remote_error import RemoteFileError
from coframe._sources.urls import STORES, remove_credentials, scheme_of

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["StoreFolder", "StoreRanges"]

MAX_WAIT: Final = 60.0  # seconds for one request
MIN_SPEED: Final = 20_000  # bytes per second; a slower response is given up
MAX_FILES: Final = 10_000  # of a folder
_CHECK_PERIOD: Final = 10.0  # seconds after which it is checked whether the file has changed
_VERSION_KEYS: Final = ("ETag", "etag", "md5Hash", "generation", "LastModified", "last_modified", "updated", "mtime")
_CREDENTIAL_HINTS: Final = {
    "s3": "Set AWS_PROFILE, or AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY; for public data, set FSSPEC_S3_ANON=true.",
    "gs": "Set GOOGLE_APPLICATION_CREDENTIALS; for public data, set FSSPEC_GS_TOKEN=anon.",
    "az": "Set AZURE_STORAGE_ACCOUNT_NAME and AZURE_STORAGE_ACCOUNT_KEY, or AZURE_STORAGE_CONNECTION_STRING.",
}


class _Store:
    """The file system of a URL, whose errors become sentences."""

    def __init__(self, url: str) -> None:
        self.name = remove_credentials(url)
        self._scheme = scheme_of(url)
        package = STORES[self._scheme]
        for module in ("fsspec", package):
            try:
                importlib.import_module(module)
            except ImportError as error:
                self._fail(f"{self._scheme}:// needs the package {error.name or module}", pip_install("remote"))
        core: Any = importlib.import_module("fsspec.core")
        self._files, self.path = self._call(core.url_to_fs, url.strip())

    def info(self) -> dict[str, Any]:
        """Return the current metadata of the path from the store."""
        self._call(self._files.invalidate_cache)
        return dict(self._call(self._files.info, self.path, timeout=MAX_WAIT))

    def read(self, start: int, end: int) -> bytes:
        """Return a range of bytes."""
        wait = MAX_WAIT + (end - start) / MIN_SPEED
        return bytes(self._call(self._files.cat_file, self.path, start=start, end=end, timeout=wait))

    def list(self) -> list[str]:
        """Return the names of the files in a folder, sorted."""
        found = self._call(self._files.ls, self.path, detail=True, timeout=MAX_WAIT)
        names = [str(each["name"]).rpartition("/")[2] for each in found if each.get("type") == "file"]
        return sorted(filter(None, names))[:MAX_FILES]

    def _call(self, function: Callable[..., Any], *values: Any, **options: Any) -> Any:
        try:
            return function(*values, **options)
        except Exception as error:  # noqa: BLE001 - the packages raise the exceptions of their libraries
            self._fail(*_reason(error, self._scheme))

    def _fail(self, reason: str, hint: str = "", number: int = errno.EIO) -> NoReturn:
        raise RemoteFileError.because(self.name, reason, hint, number) from None


class StoreRanges(_Store):
    """A file in an object store; see :class:`coframe._sources.block_cache.ByteRanges`.

    Attributes:
        size: Its size in bytes.
        is_folder: Whether the URL is that of a folder; it then has no bytes.
    """

    def __init__(self, url: str) -> None:
        super().__init__(url)
        info = self.info()
        self.is_folder = info.get("type") == "directory"
        self.size = 0 if self.is_folder else self._size(info)
        self.version = _version(info)
        self._checked_at = time.monotonic()

    def read_range(self, start: int, end: int) -> bytes:
        """Return the bytes from ``start`` to ``end``."""
        if time.monotonic() - self._checked_at > _CHECK_PERIOD:
            self._check_version()
        data = self.read(start, end)
        if len(data) != end - start:
            self._check_version()
        return data

    def _check_version(self) -> None:
        info = self.info()
        if _version(info) != self.version or self._size(info) != self.size:
            self._fail("it has changed since it was opened", "Open it again.", errno.ESTALE)
        self._checked_at = time.monotonic()

    def _size(self, info: dict[str, Any]) -> int:
        size = info.get("size")
        if not isinstance(size, int) or size < 0:
            self._fail("the store does not state its size")
        return size

    def close(self) -> None:
        """Do nothing: fsspec keeps the connections for other files."""


class StoreFolder(_Store):
    """A folder in an object store."""


def _version(info: dict[str, Any]) -> tuple[str, ...]:
    return tuple(str(info[key]) for key in _VERSION_KEYS if info.get(key) is not None)


def _reason(error: Exception, scheme: str) -> tuple[str, str, int]:
    """Return why a file cannot be read, what to do, and the number of a similar error of the operating system."""
    hint = _CREDENTIAL_HINTS.get({"gcs": "gs", "abfs": "az", "abfss": "az"}.get(scheme, scheme), "")
    kind = type(error).__name__
    if isinstance(error, FileNotFoundError):
        return "there is no such file in the store", "Check the URL.", errno.ENOENT
    if isinstance(error, PermissionError) or "Credential" in kind or "Auth" in kind:
        return "the store refuses access", hint, errno.EACCES
    if isinstance(error, TimeoutError) or "Timeout" in kind:
        return "the store does not answer", "Check the network and the address of the store.", errno.ETIMEDOUT
    text = remove_credentials(" ".join(str(error).split()))[:200].rstrip(".") or "no reason given"
    is_absent = "account" in text.lower() and isinstance(error, ValueError)
    return f"{kind}: {text}", hint if is_absent else "", errno.EIO
