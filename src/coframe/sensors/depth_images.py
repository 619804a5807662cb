# SPDX-License-Identifier: Apache-2.0
"""Decode the depth images of compressed_depth_image_transport: PNG or RVL behind a header of twelve bytes."""

from __future__ import annotations

import struct
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe import _core
from coframe.errors import DecodeError

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["MAX_DEPTH_PIXELS", "decode_compressed_depth", "decode_gray_png", "is_gray_16"]

MAX_DEPTH_PIXELS = 1 << 25
"""A small message could otherwise need any amount of memory."""
_HEADER = struct.Struct("<iff")
_RVL_SIZE = struct.Struct("<ii")
_PNG = b"\x89PNG\r\n\x1a\n"
_GRAY, _GRAY_8_BITS, _GRAY_16_BITS = 0, 8, 16


def decode_compressed_depth(image: Any) -> NDArray[Any]:
    """Return the depths of a CompressedImage whose format names compressedDepth.

    Returns:
        uint16 values in the unit of the sensor, usually millimeters; or float32 meters, NaN where there is no
        measurement. Shape (height, width).

    Raises:
        DecodeError: The data is incomplete or has another format.
    """
    data = bytes(image.data)
    if len(data) < _HEADER.size:
        raise DecodeError(f"a compressed depth image of {len(data)} bytes has no header")
    _, quantum, offset = _HEADER.unpack_from(data)
    content = data[_HEADER.size :]
    stored = decode_gray_png(content) if content.startswith(_PNG) else decode_rvl(content)
    if not image.format.lstrip().startswith("32FC1"):
        return stored
    with np.errstate(divide="ignore", invalid="ignore"):
        depths: NDArray[Any] = np.float32(quantum) / (stored.astype(np.float32) - np.float32(offset))
    depths[stored == 0] = np.nan
    return depths


def is_gray_16(data: bytes) -> bool:
    """Return whether data is a PNG with 16 bits of gray."""
    return data.startswith(_PNG) and data[24:26] == bytes((_GRAY_16_BITS, _GRAY))


def decode_gray_png(data: bytes) -> NDArray[Any]:
    """Return the values of a PNG with 8 or 16 bits of gray, (height, width).

    Raises:
        DecodeError: The data is incomplete, or has colors.
    """
    width = height = bits = 0
    compressed = bytearray()
    at = len(_PNG)
    while at + 8 <= len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        chunk = data[at + 8 : at + 8 + length]
        if kind == b"IHDR" and len(chunk) >= 13:
            width, height, bits, color, _, _, interlaced = struct.unpack_from(">IIBBBBB", chunk)
            if color != _GRAY or bits not in {_GRAY_8_BITS, _GRAY_16_BITS} or interlaced:
                raise DecodeError("the PNG data of a depth image must be gray with 8 or 16 bits, not interlaced")
        elif kind == b"IDAT":
            compressed += chunk
        at += 12 + length
    _check_size(width, height)
    row = width * bits // 8
    unpacker = zlib.decompressobj()
    try:
        rows = unpacker.decompress(bytes(compressed), height * (row + 1))
    except zlib.error as error:
        raise DecodeError(f"the PNG data is damaged: {error}") from None
    if len(rows) != height * (row + 1):
        raise DecodeError(f"the PNG data has {len(rows)} of {height * (row + 1)} bytes")
    pixels = np.empty(height * row, np.uint8)
    if not _core.unfilter_png(rows, pixels, row, bits // 8):
        raise DecodeError("the PNG data is damaged: unknown filter")
    return (
        pixels.view(">u2").reshape(height, width).astype(np.uint16)
        if bits == _GRAY_16_BITS
        else pixels.reshape(height, width)
    )


def decode_rvl(data: bytes) -> NDArray[np.uint16]:
    """Return the values of a depth image in the format of `A. Wilson, Fast Lossless Depth Image Compression`.

    Numbers consist of groups of three bits, lowest first. The values are differences in runs, between runs of zeros.

    Raises:
        DecodeError: The data is incomplete.
    """
    if len(data) < _RVL_SIZE.size:
        raise DecodeError("the depth image is neither PNG nor RVL data")
    width, height = _RVL_SIZE.unpack_from(data)
    _check_size(width, height)
    words = np.frombuffer(data, "<u4", (len(data) - _RVL_SIZE.size) // 4, _RVL_SIZE.size)
    depths = np.zeros(width * height, np.uint16)
    if not _core.decode_rvl(np.ascontiguousarray(words), depths):
        raise DecodeError("the RVL data of the depth image is incomplete")
    return depths.reshape(height, width)


def _check_size(width: int, height: int) -> None:
    if width <= 0 or height <= 0 or width * height > MAX_DEPTH_PIXELS:
        raise DecodeError(
            f"a depth image of {width} x {height} pixels cannot be read. Limit: {MAX_DEPTH_PIXELS} pixels"
        )
