# SPDX-License-Identifier: Apache-2.0
"""Sizes of JPEG and PNG images, read from their headers before anything is decoded."""

from __future__ import annotations

import struct

from coframe.errors import DecodeError

__all__ = ["JPEG_SIGNATURE", "MAX_COMPRESSED_PIXELS", "PNG_SIGNATURE", "compressed_size"]

MAX_COMPRESSED_PIXELS = 1 << 25
"""A small file could otherwise need a lot of memory."""
JPEG_SIGNATURE, PNG_SIGNATURE = b"\xff\xd8", b"\x89PNG\r\n\x1a\n"
# JPEG markers without a length, and those of the frame headers that contain the image size.
_MARKERS_WITHOUT_LENGTH = {0x01, *range(0xD0, 0xD9)}
_SIZE_MARKERS = {*range(0xC0, 0xD0)} - {0xC4, 0xC8, 0xCC}


def compressed_size(head: bytes) -> tuple[int, int]:
    """Return the width and height of an image in pixels, from the first 64 KiB of its data.

    Raises:
        DecodeError: The data is neither PNG nor JPEG, or contains no size.
    """
    if head.startswith(PNG_SIGNATURE):
        return _size_of_png(head)
    if head.startswith(JPEG_SIGNATURE):
        return _size_of_jpeg(head)
    raise DecodeError("the data is neither JPEG nor PNG")


def _size_of_png(head: bytes) -> tuple[int, int]:
    if len(head) < 24:
        raise DecodeError("the PNG data is incomplete")
    width, height = struct.unpack_from(">II", head, 16)
    return int(width), int(height)


def _size_of_jpeg(head: bytes) -> tuple[int, int]:
    at = 2
    while at + 9 <= len(head) and head[at] == 0xFF:
        marker = head[at + 1]
        if marker in _SIZE_MARKERS:
            height, width = struct.unpack_from(">HH", head, at + 5)
            return int(width), int(height)
        if marker == 0xFF:
            at += 1
        elif marker in _MARKERS_WITHOUT_LENGTH:
            at += 2
        else:
            at += 2 + int.from_bytes(head[at + 2 : at + 4], "big")
    raise DecodeError("the JPEG data contains no image size")
