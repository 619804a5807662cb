# SPDX-License-Identifier: Apache-2.0
"""Camera images: raw images as gray or RGB pixels, compressed images unchanged."""

from __future__ import annotations

import math
import struct
from typing import Any

import numpy as np

from coframe.time import stamp_ns
from coframe.viewer.displays._drawing import CannotDrawError, Drawing, Options
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ChoiceOption, DisplayRow, FlagOption, NumberOption, Option
from coframe.viewer.protocol.binary_messages import ImageFormat
from coframe.viewer.protocol.encoding import encode_image

__all__ = ["CAMERA", "IMAGE", "MAX_PIXELS", "draw_compressed_image", "draw_image"]

MAX_PIXELS = 640 * 480
"""Raw images with more pixels are thinned to every n-th row and column."""
MAX_COMPRESSED_PIXELS = 1 << 25  # A small file may need a lot of memory in the browser.
MAX_COMPRESSED_BYTES = 16 << 20
# For each encoding: bytes per pixel, and the indices of red, green and blue, or of gray.
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
# JPEG markers without a length, and those of the frame headers that contain the image size.
_MARKERS_WITHOUT_LENGTH = {0x01, *range(0xD0, 0xD9)}
_SIZE_MARKERS = {*range(0xC0, 0xD0)} - {0xC4, 0xC8, 0xCC}


def draw_image(image: Any, options: Options) -> Drawing:
    """Draw an Image with eight bits per channel."""
    if image.encoding not in _CHANNELS:
        known = ", ".join(_CHANNELS)
        raise CannotDrawError(f"image encoding {image.encoding[:40]!r} is not supported. Supported: {known}, JPEG, PNG")
    size, channels = _CHANNELS[image.encoding]
    height, width, step = image.height, image.width, image.step
    data = np.frombuffer(image.data, np.uint8)
    if step < width * size or len(data) < height * step:
        raise CannotDrawError(f"an image of {width} x {height} pixels has only {len(data)} bytes, {step} per row")
    if not height or not width:
        raise CannotDrawError("the image has no pixels")
    every = max(1, math.ceil(math.sqrt(width * height / MAX_PIXELS)))
    pixels = data[: height * step].reshape(height, step)[::every, : width * size].reshape(-1, width, size)[:, ::every]
    kind = ImageFormat.GRAY if len(channels) == 1 else ImageFormat.RGB
    pixels = pixels[:, :, channels]
    stamp = stamp_ns(image.header.stamp)
    height, width = pixels.shape[:2]
    message = encode_image(kind, width, height, pixels, float(stamp - options.origin), every)
    return Drawing(image.header.frame_id, stamp, message, placed=False)


def draw_compressed_image(image: Any, options: Options) -> Drawing:
    """Draw a CompressedImage that contains JPEG or PNG data, regardless of its format field."""
    data = np.frombuffer(image.data, np.uint8)
    head = bytes(data[: 1 << 16])
    if not head.startswith((_JPEG, _PNG)):
        raise CannotDrawError(f"image format {image.format[:40]!r} is not supported. Supported: JPEG, PNG")
    width, height = _size_of_png(head) if head.startswith(_PNG) else _size_of_jpeg(head)
    if width * height > MAX_COMPRESSED_PIXELS or len(data) > MAX_COMPRESSED_BYTES:
        raise CannotDrawError(
            f"an image of {width} x {height} pixels in {len(data)} bytes is too large. Limits: "
            f"{MAX_COMPRESSED_PIXELS} pixels, {MAX_COMPRESSED_BYTES} bytes"
        )
    kind = ImageFormat.PNG if head.startswith(_PNG) else ImageFormat.JPEG
    stamp = stamp_ns(image.header.stamp)
    message = encode_image(kind, width, height, data, float(stamp - options.origin))
    return Drawing(image.header.frame_id, stamp, message, placed=False)


def _size_of_png(head: bytes) -> tuple[int, int]:
    if len(head) < 24:
        raise CannotDrawError("the PNG data is incomplete")
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
    raise CannotDrawError("the JPEG data contains no image size")


def _options(*, project: bool) -> tuple[Option, ...]:
    needs = "Project"
    return (
        NumberOption("Width", 260.0, 60.0, 1600.0, 20.0, "px"),
        FlagOption("Project", project, label="Project the scene"),
        FlagOption("Project Frames", True, label="Frames", needs=needs),
        FlagOption("Project Clouds", True, label="Clouds", needs=needs),
        FlagOption("Project Shapes", True, label="Markers and paths", needs=needs),
        ChoiceOption("Rectified", "By topic", ("By topic", "Yes", "No"), needs=needs),
    )


IMAGE = DisplayRow(
    name="Image",
    messages={
        "sensor_msgs/msg/CompressedImage": draw_each_message(draw_compressed_image),
        "sensor_msgs/msg/Image": draw_each_message(draw_image),
    },
    options=_options(project=False),
    automatic=False,
    large_in_replay=True,
    has_surfaces=False,
)
CAMERA = DisplayRow(
    name="Camera",
    messages=IMAGE.messages,
    options=_options(project=True),
    selectable=False,
    automatic=False,
    large_in_replay=True,
    has_surfaces=False,
)
