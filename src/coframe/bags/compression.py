"""Unpacking with a limit, and as far as damaged data allow."""

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

LARGEST = 512 << 20  # bytes: no chunk or message that anybody writes is as large


class DamagedError(CoframeError):
    """A piece of a file that cannot be read; the text says why."""


def unpack(compression: str, data: bytes | memoryview, size: int) -> bytes:
    """What was compressed, or the part of it before the first damage.

    Args:
        compression: ``""`` or ``"none"``, ``"zstd"``, ``"lz4"`` (frames) or ``"bz2"``.
        data: The packed bytes.
        size: How large the file says that they are unpacked.

    Raises:
        DamagedError: Nothing of it can be unpacked, it says that it is larger than anything is, or nobody knows that
            compression.
        RecordingError: The package that knows it is not installed.
    """
    if compression in {"", "none"}:
        return bytes(data)
    if compression not in _OPENERS:
        raise DamagedError(f"compressed by {compression[:20]!r}, which is none of {', '.join(_OPENERS)}")
    if size > LARGEST:
        raise DamagedError(f"a chunk that claims to be {size} bytes")
    open_ = _OPENERS[compression]()
    try:
        whole: bytes = open_(data).read(size)
    except Exception as error:  # noqa: BLE001 - each library has exceptions of its own
        whole = _undamaged(open_(data), size)
        if not whole:
            raise DamagedError(f"{compression} says: {error}") from None
    return whole


def _undamaged(reader: Any, size: int) -> bytes:
    """What comes before the damage."""
    whole = bytearray()
    with contextlib.suppress(Exception):
        while len(whole) < size and (piece := reader.read(min(_PIECE, size - len(whole)))):
            whole += piece
    return bytes(whole)


_PIECE = 4096


def _zstd() -> Callable[[Any], Any]:
    zstandard = _module("zstandard")
    return lambda data: zstandard.ZstdDecompressor().stream_reader(data)


def _lz4() -> Callable[[Any], Any]:
    lz4_frame = _module("lz4.frame")
    return lambda data: lz4_frame.open(io.BytesIO(data))


def _bz2() -> Callable[[Any], Any]:
    return lambda data: bz2.open(io.BytesIO(data))


# By name: what gives a function that makes a file of packed bytes, or says what is missing.
_OPENERS: dict[str, Callable[[], Callable[[Any], Any]]] = {"zstd": _zstd, "lz4": _lz4, "bz2": _bz2}


def _module(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        raise RecordingError(
            f"this recording is compressed, and the package {name.partition('.')[0]} is not installed",
            hint="pip install 'coframe[bags]'",
        ) from None
