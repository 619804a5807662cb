"""Pictures of cameras: raw ones as grey or colours, compressed ones as they came."""

from __future__ import annotations

import math
import struct
from typing import Any

import numpy as np

from coframe.time import stamp_ns
from coframe.viewer.displays.drawing import CannotDrawError, Drawing, Options
from coframe.viewer.protocol import binary

__all__ = ["MOST_PIXELS", "draw_compressed_image", "draw_image"]

MOST_PIXELS = 640 * 480  # of a raw one; of larger ones every so-manieth row and column is sent
MOST_COMPRESSED_PIXELS = 1 << 25  # they are small, and become large in the browser
MOST_COMPRESSED_BYTES = 16 << 20
# By encoding: bytes a pixel, and which of them are red, green and blue, or grey.
_CHANNELS = {
    "8UC1": (1, [0]),
    "8UC3": (3, [2, 1, 0]),
    "bgr8": (3, [2, 1, 0]),
    "bgra8": (4, [2, 1, 0]),
    "mono8": (1, [0]),
    "rgb8": (3, [0, 1, 2]),
    "rgba8": (4, [0, 1, 2]),
}
_JPEG, _PNG = b"\xff\xd8", b"\x89PNG\r\n\x1a\n"
# Markers of JPEG: those before the size that have no length, and those that tell the size.
_BARE = {0x01, *range(0xD0, 0xD9)}
_SIZES = {*range(0xC0, 0xD0)} - {0xC4, 0xC8, 0xCC}


def draw_image(image: Any, options: Options) -> Drawing:
    """An Image of eight bits a channel."""
    if image.encoding not in _CHANNELS:
        known = ", ".join(_CHANNELS)
        raise CannotDrawError(
            f"an image of the encoding {image.encoding[:40]!r}: the viewer draws {known}, JPEG and PNG"
        )
    size, channels = _CHANNELS[image.encoding]
    height, width, step = image.height, image.width, image.step
    data = np.frombuffer(image.data, np.uint8)
    if step < width * size or len(data) < height * step:
        raise CannotDrawError(f"an image of {width} x {height} pixels comes with {len(data)} bytes, {step} a row")
    if not height or not width:
        raise CannotDrawError("an image without pixels")
    every = max(1, math.ceil(math.sqrt(width * height / MOST_PIXELS)))
    pixels = data[: height * step].reshape(height, step)[::every, : width * size].reshape(-1, width, size)[:, ::every]
    kind = binary.GREY if len(channels) == 1 else binary.RGB
    return _drawn(image, kind, pixels[:, :, channels], options, every)


def draw_compressed_image(image: Any, options: Options) -> Drawing:
    """A CompressedImage that a browser can read: JPEG or PNG, whatever its format is called."""
    data = np.frombuffer(image.data, np.uint8)
    head = bytes(data[: 1 << 16])
    if not head.startswith((_JPEG, _PNG)):
        raise CannotDrawError(f"a compressed image of the format {image.format[:40]!r}: the viewer draws JPEG and PNG")
    width, height = _size_of_png(head) if head.startswith(_PNG) else _size_of_jpeg(head)
    if width * height > MOST_COMPRESSED_PIXELS or len(data) > MOST_COMPRESSED_BYTES:
        raise CannotDrawError(f"an image of {width} x {height} pixels in {len(data)} bytes: that is too large to draw")
    kind = binary.PNG if head.startswith(_PNG) else binary.JPEG
    message = binary.image(kind, width, height, data, float(stamp_ns(image.header.stamp) - options.origin))
    return Drawing(image.header.frame_id, stamp_ns(image.header.stamp), message, placed=False)


def _drawn(image: Any, kind: int, pixels: Any, options: Options, every: int) -> Drawing:
    stamp = stamp_ns(image.header.stamp)
    height, width = pixels.shape[:2]
    data = binary.image(kind, width, height, pixels, float(stamp - options.origin), every)
    return Drawing(image.header.frame_id, stamp, data, placed=False)


def _size_of_png(head: bytes) -> tuple[int, int]:
    if len(head) < 24:
        raise CannotDrawError("a PNG image that ends too early")
    width, height = struct.unpack_from(">II", head, 16)
    return int(width), int(height)


def _size_of_jpeg(head: bytes) -> tuple[int, int]:
    at = 2
    while at + 9 <= len(head) and head[at] == 0xFF:
        marker = head[at + 1]
        if marker in _SIZES:
            height, width = struct.unpack_from(">HH", head, at + 5)
            return int(width), int(height)
        at += 1 if marker == 0xFF else 2 if marker in _BARE else 2 + int.from_bytes(head[at + 2 : at + 4], "big")
    raise CannotDrawError("a JPEG image that does not tell its size")
