# SPDX-License-Identifier: Apache-2.0
"""Pictures of image messages for notebooks: a small PNG, or the JPEG or PNG data of a compressed image."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe._output.png import encode_png
from coframe.errors import DecodeError
from coframe.sensors.compressed_images import (
    MAX_COMPRESSED_PIXELS,
    compressed_size,
)
from coframe.sensors.depth_images import decode_compressed_depth, decode_gray_png, is_gray_16
from coframe.sensors.image_pixels import decode_image

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.messages.message import Message
    from coframe.sensors.image_pixels import Pixels

__all__ = ["MAX_PICTURE_BYTES", "MAX_PICTURE_SIZE", "picture_of"]

MAX_PICTURE_SIZE = 640
"""Larger images are thinned to at most this width and height in pixels."""
MAX_PICTURE_BYTES = 2 << 20
"""JPEG and PNG data of more bytes is not shown, because notebooks store their pictures."""
# The fields that an image needs. A recording may define another type with the same name.
_IMAGE_FIELDS = {
    "height": "uint32",
    "width": "uint32",
    "encoding": "string",
    "is_bigendian": "uint8",
    "step": "uint32",
    "data": "sequence<uint8>",
}
_COMPRESSED_FIELDS = {"format": "string", "data": "sequence<uint8>"}
_HEAD = 1 << 16  # bytes in which the size of a JPEG or PNG image is


def picture_of(message: Message) -> bytes | None:
    """Return an Image or CompressedImage as JPEG or PNG, or None for other messages and for images without data.

    Values that are not colors, such as depths, are scaled from their minimum and maximum to black and white.

    Raises:
        DecodeError: The image cannot be read, or is too large.
    """
    fields = message.get_fields_and_field_types().items()
    if fields >= _IMAGE_FIELDS.items():
        return _encode_image(message)
    return _encode_compressed(message) if fields >= _COMPRESSED_FIELDS.items() else None


def _encode_image(message: Any) -> bytes | None:
    return _encode(decode_image(message)) if len(message.data) else None


def _encode_compressed(message: Any) -> bytes | None:
    if not len(message.data):
        return None
    if "compressedDepth" in message.format:
        return _encode(decode_compressed_depth(message))
    data = bytes(message.data)
    if is_gray_16(data):  # A browser would show the millimeters of a depth image as black.
        return _encode(decode_gray_png(data))
    width, height = compressed_size(data[:_HEAD])
    if width * height > MAX_COMPRESSED_PIXELS:
        raise DecodeError(f"{width} x {height} pixels exceed the maximum of {MAX_COMPRESSED_PIXELS}")
    if len(data) > MAX_PICTURE_BYTES:
        raise DecodeError(f"{len(data)} bytes exceed the maximum of {MAX_PICTURE_BYTES} for pictures in notebooks")
    return data


def _encode(pixels: Pixels) -> bytes:
    every = -(-max(pixels.shape[:2]) // MAX_PICTURE_SIZE)
    return encode_png(_eight_bits(pixels[::every, ::every]))


def _eight_bits(pixels: Pixels) -> NDArray[np.uint8]:
    if pixels.dtype == np.uint8:
        return pixels
    values = pixels.astype(np.float64)
    finite = values[np.isfinite(values)]
    lowest, highest = (finite.min(), finite.max()) if finite.size else (0.0, 0.0)
    scaled = (np.clip(values, lowest, highest) - lowest) * (255.0 / (highest - lowest) if highest > lowest else 0.0)
    return np.nan_to_num(scaled).astype(np.uint8)
