# SPDX-License-Identifier: Apache-2.0
"""Decompression with a size limit that recovers the undamaged beginning of damaged data."""

from __future__ import annotations

import bz2
import contextlib
import importlib
import io
from typing import TYPE_CHECKING, Any

from coframe.errors import CoframeError, RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["LARGEST", "DamagedError", "unpack"]

LARGEST = 512 << 20  # bytes: real chunks and messages are smaller


class DamagedError(CoframeError):
    """Part of a file cannot be read; the text says why."""


def unpack(compression: str, data: bytes | memoryview, size: int) -> bytes:
    """Unpack compressed data, or the part of it before the first damage.

    Args:
        compression: ``""`` or ``"none"``, ``"zstd"``, ``"lz4"`` (frames) or ``"bz2"``.
        data: The compressed bytes.
        size: The unpacked size in bytes, as the file states it.

    Raises:
        DamagedError: No data can be unpacked, the stated size is above :data:`LARGEST`, or the compression is unknown.
        RecordingError: The package for this compression is not installed.
    """
    if compression in {"", "none"}:
        return bytes(data)
    if compression not in _OPENERS:
        raise DamagedError(f"unknown compression {compression[:20]!r}; known: {', '.join(_OPENERS)}")
    if size > LARGEST:
        raise DamagedError(f"a chunk claims to have {size} bytes, more than the limit of {LARGEST}")
    open_ = _OPENERS[compression]()
    try:
        unpacked: bytes = open_(data).read(size)
    except Exception as error:  # noqa: BLE001 - each library has exceptions of its own
        unpacked = _undamaged(open_(data), size)
        if not unpacked:
            raise DamagedError(f"{compression} reports: {error}") from None
    return unpacked


def _undamaged(reader: Any, size: int) -> bytes:
    """Return the data before the damage."""
    unpacked = bytearray()
    with contextlib.suppress(Exception):
        while len(unpacked) < size and (piece := reader.read(min(_PIECE, size - len(unpacked)))):
            unpacked += piece
    return bytes(unpacked)


_PIECE = 4096  # bytes


def _zstd() -> Callable[[Any], Any]:
    zstandard = _module("zstandard")
    return lambda data: zstandard.ZstdDecompressor().stream_reader(data)


def _lz4() -> Callable[[Any], Any]:
    lz4_frame = _module("lz4.frame")
    return lambda data: lz4_frame.open(io.BytesIO(data))


def _bz2() -> Callable[[Any], Any]:
    return lambda data: bz2.open(io.BytesIO(data))


# By compression: a factory for the function that opens compressed bytes as a file. The factory raises if the package is
# not installed.
_OPENERS: dict[str, Callable[[], Callable[[Any], Any]]] = {"zstd": _zstd, "lz4": _lz4, "bz2": _bz2}


def _module(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        raise RecordingError(
            f"the recording is compressed, and the package {name.partition('.')[0]} is not installed",
            hint="pip install 'coframe[bags]'",
        ) from None
