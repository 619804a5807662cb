# SPDX-License-Identifier: Apache-2.0
"""Camera images: raw images as gray or RGB pixels, compressed images unchanged."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.errors import DecodeError
from coframe.sensors.compressed_images import (
    JPEG_SIGNATURE,
    MAX_COMPRESSED_PIXELS,
    PNG_SIGNATURE,
    compressed_size,
)
from coframe.sensors.depth_images import decode_compressed_depth, decode_gray_png, is_gray_16
from coframe.sensors.image_pixels import Pixels, decode_image
from coframe.time import stamp_ns
from coframe.viewer.displays._drawing import CannotDrawError, Drawing, Options
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ChoiceOption, DisplayRow, FlagOption, NumberOption, Option
from coframe.viewer.displays.kinds._video import VideoStream, codec_of
from coframe.viewer.protocol.binary_messages import ImageFormat
from coframe.viewer.protocol.encoding import encode_image

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["CAMERA", "IMAGE", "draw_compressed_image", "draw_image"]

MAX_COMPRESSED_BYTES = 16 << 20
_FORMATS = {"uint8": ImageFormat.GRAY, "uint16": ImageFormat.GRAY16, "float32": ImageFormat.FLOAT}
_COMPRESSED_FORMATS = "JPEG, PNG, compressedDepth, h264, h265"


def draw_image(image: Any, options: Options) -> Drawing:
    """Draw an Image: brightness and colors with eight bits per channel, measured values unchanged."""
    return _draw_decoded(image, decode_image, options)


def _draw_decoded(message: Any, decode: Callable[[Any], Pixels], options: Options) -> Drawing:
    """Draw decoded pixels, thinned to the number that the page requests."""
    try:
        pixels = decode(message)
    except DecodeError as error:
        raise CannotDrawError(str(error)) from None
    height, width = pixels.shape[:2]
    every = max(1, math.ceil(math.sqrt(width * height / options.max_pixels)))
    kind = ImageFormat.RGB if pixels.ndim == 3 else _FORMATS[pixels.dtype.name]
    if every > 1:
        # Depths are not averaged, because there is nothing at the average of two depths.
        pixels = _average(pixels, every) if pixels.dtype == np.uint8 else pixels[::every, ::every]
    height, width = pixels.shape[:2]
    stamp = stamp_ns(message.header.stamp)
    data = encode_image(kind, width, height, pixels, float(stamp - options.origin), every)
    return Drawing(message.header.frame_id, stamp, data, placed=False)


def _average(pixels: Pixels, every: int) -> Pixels:
    """Return the averages of squares of pixels, so that thin lines do not vanish."""
    height, width = (length // every * every for length in pixels.shape[:2])
    if not height or not width:
        return pixels[::every, ::every]
    total = np.zeros((height // every, width // every, *pixels.shape[2:]), np.uint32)
    for row in range(every):
        for column in range(every):
            total += pixels[row:height:every, column:width:every]
    return (total // every**2).astype(np.uint8)


def draw_compressed_image(image: Any, options: Options) -> Drawing:
    """Draw a CompressedImage that contains JPEG or PNG data, regardless of its format field, or a depth image."""
    if "compressedDepth" in image.format:
        return _draw_decoded(image, decode_compressed_depth, options)
    data = np.frombuffer(image.data, np.uint8)
    head = bytes(data[: 1 << 16])
    if not head.startswith((JPEG_SIGNATURE, PNG_SIGNATURE)):
        raise CannotDrawError(f"image format {image.format[:40]!r} is not supported. Supported: {_COMPRESSED_FORMATS}")
    if is_gray_16(head):  # The browser would reduce it to eight bits.
        return _draw_decoded(image, lambda _image: decode_gray_png(bytes(data)), options)
    try:
        width, height = compressed_size(head)
    except DecodeError as error:
        raise CannotDrawError(str(error)) from None
    if width * height > MAX_COMPRESSED_PIXELS or len(data) > MAX_COMPRESSED_BYTES:
        raise CannotDrawError(
            f"an image of {width} x {height} pixels in {len(data)} bytes is too large. Limits: "
            f"{MAX_COMPRESSED_PIXELS} pixels, {MAX_COMPRESSED_BYTES} bytes"
        )
    kind = ImageFormat.PNG if head.startswith(PNG_SIGNATURE) else ImageFormat.JPEG
    stamp = stamp_ns(image.header.stamp)
    message = encode_image(kind, width, height, data, float(stamp - options.origin))
    return Drawing(image.header.frame_id, stamp, message, placed=False)


class CompressedImageRenderer:
    """Draws compressed images: each by itself, or as a part of a video."""

    def __init__(self, messages: TopicMessages, options: Options, _resources: Resources) -> None:
        self._options = options
        self._video = VideoStream(messages, options)

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return the drawing of the message."""
        del time, at
        image = message.read()
        codec = codec_of(image.format)
        if codec is not None:
            return [self._video.draw(message, image, codec)]
        return [draw_compressed_image(image, self._options)]

    def has_changed(self, time: int, at: int) -> bool:
        """Return False."""
        del time, at
        return False


class FFMPEGPacketRenderer:
    """Draws the packets of ffmpeg_image_transport, whose definition is in the recording or the user's ROS packages."""

    def __init__(self, messages: TopicMessages, options: Options, _resources: Resources) -> None:
        self._video = VideoStream(messages, options)

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return the drawing of the message.

        Raises:
            CannotDrawError: The page cannot decode the encoding.
        """
        del time, at
        packet = message.read()
        codec = codec_of(packet.encoding.replace("lib", ""))  # The encoding may be the name of an encoder: libx264.
        if codec is None:
            raise CannotDrawError(f"the encoding {packet.encoding!r} cannot be displayed. Known encodings: h264, h265.")
        return [self._video.draw(message, packet, codec)]

    def has_changed(self, time: int, at: int) -> bool:
        """Return False."""
        del time, at
        return False


def _options(*, project: bool) -> tuple[Option, ...]:
    needs = "Project"
    overlays = "overlay|background and overlay"
    return (
        NumberOption("Width", 260.0, 60.0, 1600.0, 20.0, "px"),
        FlagOption("Normalize Range", True),
        NumberOption("Min Value", 0.0, -1e9, 1e9, 0.1, needs="!Normalize Range"),
        NumberOption("Max Value", 1.0, -1e9, 1e9, 0.1, needs="!Normalize Range"),
        NumberOption("Median window", 5.0, 1.0, 50.0, 1.0, needs="Normalize Range"),
        FlagOption("Project", project, label="Project the scene"),
        FlagOption("Project Frames", True, label="Frames", needs=needs),
        FlagOption("Project Clouds", True, label="Clouds", needs=needs),
        FlagOption("Project Shapes", True, label="Markers and paths", needs=needs),
        FlagOption("Project Detections", True, label="Detections"),
        NumberOption("Far Plane Distance", 100.0, 0.01, 1e6, 10.0, "m", needs=needs),
        ChoiceOption("Image Rendering", "background", ("background", "overlay", "background and overlay"), needs=needs),
        NumberOption("Overlay Alpha", 0.5, 0.0, 1.0, 0.05, needs=f"{needs} & Image Rendering={overlays}"),
        NumberOption("Zoom Factor", 1.0, 1.0, 64.0, 0.5),
        ChoiceOption("Rectified", "By topic", ("By topic", "Yes", "No"), needs=needs),
    )


_GUIDE = (
    "Image with one to four channels of 8 or 16 bits or floating-point numbers (mono, rgb, bgr, Bayer, yuv422, nv12, "
    "nv21, depths), CompressedImage as JPEG, PNG, compressedDepth (PNG, RVL), or h264 and h265 if the browser decodes "
    "them, FFMPEGPacket of ffmpeg_image_transport with the same codecs; values have a normalized range; the "
    "wheel zooms, dragging pans, and the pointer shows the value of a pixel"
)

IMAGE = DisplayRow(
    name="Image",
    messages={
        "sensor_msgs/msg/CompressedImage": CompressedImageRenderer,
        "sensor_msgs/msg/Image": draw_each_message(draw_image),
        "ffmpeg_image_transport_msgs/msg/FFMPEGPacket": FFMPEGPacketRenderer,
    },
    options=_options(project=False),
    automatic=False,
    large_in_replay=True,
    has_surfaces=False,
    guide=_GUIDE,
)
CAMERA = DisplayRow(
    name="Camera",
    messages={
        "sensor_msgs/msg/CompressedImage": CompressedImageRenderer,
        "sensor_msgs/msg/Image": draw_each_message(draw_image),
    },
    options=_options(project=True),
    selectable=False,
    automatic=False,
    large_in_replay=True,
    has_surfaces=False,
    guide="Image and CompressedImage with the scene above them: an Image with the option *Project the scene*",
    lacks="maps and the faces of robots: the scene is drawn as points and lines above the image",
)
