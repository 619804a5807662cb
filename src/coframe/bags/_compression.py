# SPDX-License-Identifier: Apache-2.0
"""Decompress with a size limit, and recover the undamaged beginning of damaged data."""

from __future__ import annotations

import bz2
import contextlib
import importlib
import io
from typing import TYPE_CHECKING, Any

from coframe._process.optional_imports import pip_install
from coframe.errors import CoframeError, RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["MAX_UNPACKED_BYTES", "MAX_UNPACKED_MESSAGE", "DamagedError", "unpack", "unpack_beginning", "unpack_message"]

MAX_UNPACKED_BYTES = 512 << 20  # bytes of a record or an unpacked chunk: real ones are smaller
MAX_UNPACKED_MESSAGE = 128 << 20  # bytes of an unpacked message
# Recorders finish a chunk at about 1 MB, so only a chunk with one huge message is larger than this, and such a message
# does not consist only of zeros.
_MAX_SMALL_SIZE = 64 << 20
_MAX_RATIO = 1000  # unpacked to packed size, above _PLAUSIBLE


class DamagedError(CoframeError):
    """Part of a file cannot be read. The message gives the reason."""


def unpack(compression: str, data: bytes | memoryview, size: int) -> bytes:
    """Unpack compressed data, or the part before the first damage.

    Args:
        compression: ``""`` or ``"none"``, ``"zstd"``, ``"lz4"`` (frames) or ``"bz2"``.
        data: The compressed bytes.
        size: The unpacked size in bytes, as stated by the file.

    Raises:
        DamagedError: No data can be unpacked, the stated size is above :data:`MAX_UNPACKED_BYTES` or implausible for
            the packed size, or the compression is unknown.
        RecordingError: The package for this compression is not installed.
    """
    if compression in {"", "none"}:
        return bytes(data)
    if compression not in _OPENERS:
        raise DamagedError(f"unknown compression {compression[:20]!r}; known: {', '.join(_OPENERS)}")
    if size > MAX_UNPACKED_BYTES:
        raise DamagedError(f"a chunk claims to have {size} bytes; the maximum is {MAX_UNPACKED_BYTES}")
    if size > max(_MAX_SMALL_SIZE, _MAX_RATIO * len(data)) + 1:
        raise DamagedError(
            f"a chunk of {len(data)} bytes claims to unpack to {size} bytes, more than {_MAX_RATIO} times as many"
        )
    open_ = _OPENERS[compression]()
    try:
        unpacked: bytes = open_(data).read(size)
    except Exception as error:  # noqa: BLE001 - each library has its own exceptions
        unpacked = _read_undamaged(open_(data), size)
        if not unpacked:
            raise DamagedError(f"{compression} reports: {error}") from None
    return unpacked


def unpack_beginning(compression: str, data: bytes | memoryview, size: int) -> bytes:
    """Unpack the first `size` bytes of an individually compressed message; fewer if it is shorter or damaged.

    The arguments and errors are those of :func:`unpack_message`.
    """
    return unpack(compression, data, size)[:size]


def unpack_message(compression: str, data: bytes | memoryview, max_bytes: int = MAX_UNPACKED_MESSAGE) -> bytes:
    """Unpack an individually compressed message, or the part before the first damage.

    Args:
        compression: ``"zstd"``, ``"lz4"`` (frames), ``"bz2"`` or ``""``.
        data: The compressed bytes.
        max_bytes: The maximum number of unpacked bytes.

    Raises:
        DamagedError: No data can be unpacked, the message is larger than `max_bytes` or implausibly large for its
            packed size, or the compression is unknown.
        RecordingError: The package for this compression is not installed.
    """
    limit = min(max_bytes, max(_MAX_SMALL_SIZE, _MAX_RATIO * len(data)))
    # One byte more than the limit shows that the message is too large, even if the file states another size.
    if _declared_size(compression, data) > limit or len(unpacked := unpack(compression, data, limit + 1)) > limit:
        raise DamagedError(f"a message of {len(data)} bytes unpacks to more than the maximum of {limit} bytes")
    return unpacked


def _declared_size(compression: str, data: bytes | memoryview) -> int:
    """Return the unpacked size stated in compressed data, or 0 if there is none."""
    if compression != "zstd":
        return 0
    zstandard = _import_module("zstandard")
    with contextlib.suppress(zstandard.ZstdError):
        return max(int(zstandard.frame_content_size(data)), 0)
    return 0


def _read_undamaged(reader: Any, size: int) -> bytes:
    """Return the data before the damage."""
    unpacked = bytearray()
    with contextlib.suppress(Exception):
        while len(unpacked) < size and (piece := reader.read(min(_PIECE_BYTES, size - len(unpacked)))):
            unpacked += piece
    return bytes(unpacked)


_PIECE_BYTES = 4096  # bytes


def _zstd() -> Callable[[Any], Any]:
    zstandard = _import_module("zstandard")
    return lambda data: zstandard.ZstdDecompressor().stream_reader(data, read_across_frames=True)


def _lz4() -> Callable[[Any], Any]:
    lz4_frame = _import_module("lz4.frame")
    return lambda data: lz4_frame.open(io.BytesIO(data))


def _bz2() -> Callable[[Any], Any]:
    return lambda data: bz2.open(io.BytesIO(data))


# For each compression, a factory of the function that opens compressed bytes as a file. It raises if the package is not
# installed.
_OPENERS: dict[str, Callable[[], Callable[[Any], Any]]] = {"zstd": _zstd, "lz4": _lz4, "bz2": _bz2}


def _import_module(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        raise RecordingError(
            f"the recording is compressed, and the package {name.partition('.')[0]} is not installed",
            hint=pip_install("bags"),
        ) from None
