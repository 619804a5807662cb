# SPDX-License-Identifier: Apache-2.0
"""Decode the pixels of `sensor_msgs/Image` with NumPy only: brightness, red, green and blue, or measured values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from coframe.errors import DecodeError
from coframe.sensors import encodings

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Pixels", "decode_image", "supported_encodings"]

Pixels: TypeAlias = "NDArray[Any]"

_NV12 = "nv12"  # Not an encoding of upstream's header, but cameras use it.
_BAYER_PATTERNS = {"BayerBG": "rggb", "BayerRG": "bggr", "BayerGR": "gbrg", "BayerGB": "grbg"}
_MAX_16_BITS = 65535


def supported_encodings() -> str:
    """Return the names of the encodings that `decode_image` reads, for error messages."""
    return (
        "mono8, mono16, rgb8, rgba8, bgr8, bgra8, rgb16, rgba16, bgr16, bgra16, bayer_*8, bayer_*16, yuv422, "
        "yuv422_yuy2, uyvy, yuyv, nv12, nv21, nv24, and 8UC1 to 64FC4 with one, three or four channels"
    )


def decode_image(image: Any) -> Pixels:
    """Return the pixels of an Image message.

    Returns:
        Brightness as uint8, shape (height, width); colors as uint8, shape (height, width, 3), red first; or measured
        values, such as depths, as uint16 or float32, shape (height, width). Values that do not exist are NaN.

    Raises:
        DecodeError: The encoding is not supported, or the data does not have the size of the image.
    """
    name = image.encoding
    encoding = _find(name)
    samples = _samples(image, encoding, nv=name == _NV12)
    if encoding.colors.startswith("Bayer"):
        return _eight_bits(_demosaic(samples, _BAYER_PATTERNS[encoding.colors]))
    if encoding.colors in {"UYVY", "YUY2"}:
        return _from_yuv422(samples, brightness=1 if encoding.colors == "UYVY" else 0)
    if encoding.colors.startswith("NV"):
        return _from_nv(samples, image.height, encoding.colors if name != _NV12 else "NV12")
    if encoding.channels == 1:
        return _to_brightness(samples)
    order = [0, 1, 2] if encoding.colors.startswith("RGB") else [2, 1, 0]
    return _eight_bits(samples[:, :, order])


def _find(name: str) -> encodings.Encoding:
    try:
        found = encodings.find("nv21" if name == _NV12 else name)
    except RuntimeError:
        found = None
    color_depths = {"uint8", "uint16", "float32", "float64"}
    if found is None or (
        not found.colors
        and (found.channels not in {1, 3, 4} or (found.channels > 1 and found.dtype not in color_depths))
    ):
        raise DecodeError(f"image encoding {name[:40]!r} is not supported. Supported: {supported_encodings()}")
    return found


def _samples(image: Any, encoding: encodings.Encoding, *, nv: bool) -> Pixels:
    """Return a view of the data without padding: (rows, width), or (rows, width, channels)."""
    height, width, step = int(image.height), int(image.width), int(image.step)
    if not height or not width:
        raise DecodeError("the image has no pixels")
    dtype = np.dtype(encoding.dtype).newbyteorder(">" if image.is_bigendian else "<")
    rows = encoding.rows(height)
    size = width * encoding.channels * dtype.itemsize
    data = np.frombuffer(image.data, np.uint8)
    if step < size or len(data) < rows * step:
        raise DecodeError(f"an image of {width} x {height} pixels has only {len(data)} bytes, {step} per row")
    if (nv or encoding.colors.startswith(("NV", "UYVY", "YUY2"))) and (width % 2 or (nv and height % 2)):
        raise DecodeError(f"a {image.encoding} image of {width} x {height} pixels must have an even size")
    shape = (rows, width, encoding.channels) if encoding.channels > 1 else (rows, width)
    strides = (step, encoding.channels * dtype.itemsize, dtype.itemsize)[: len(shape)]
    samples: Pixels = np.ndarray(shape, dtype, buffer=data[: rows * step].data, strides=strides)
    return samples


def _to_brightness(samples: Pixels) -> Pixels:
    """Return values of one channel: uint8 is brightness; all others keep their unit."""
    if samples.dtype.kind == "u" and samples.dtype.itemsize <= 2:
        return samples.astype(samples.dtype.newbyteorder("="))
    with np.errstate(over="ignore"):  # Values that are too large for float32 become infinite.
        return samples.astype(np.float32)


def _eight_bits(colors: Pixels) -> Pixels:
    """Return colors as uint8; integers are scaled from their full range, and floating-point numbers from 0 to 1."""
    if colors.dtype == np.uint8:
        return colors
    if colors.dtype.kind == "u":
        return ((colors.astype(np.uint32) * 255 + _MAX_16_BITS // 2) // _MAX_16_BITS).astype(np.uint8)
    with np.errstate(over="ignore"):  # Values that are too large for float32 become infinite.
        values = colors.astype(np.float32)
    return (np.clip(np.nan_to_num(values), 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)


def _demosaic(raw: Pixels, pattern: str) -> Pixels:
    """Return red, green and blue of a Bayer image by bilinear interpolation.

    Args:
        raw: One value per pixel, (height, width).
        pattern: The colors of the first two rows' first two pixels, such as "rggb".
    """
    if min(raw.shape) < 2:
        raise DecodeError(f"a Bayer image of {raw.shape[1]} x {raw.shape[0]} pixels is too small")
    # Mirroring at the border keeps the pattern.
    padded = np.pad(raw, 1, mode="reflect").astype(np.uint32)
    up, down, left, right = padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]
    across, along = (left + right + 1) // 2, (up + down + 1) // 2
    corners = (padded[:-2, :-2] + padded[:-2, 2:] + padded[2:, :-2] + padded[2:, 2:] + 2) // 4
    cross = (left + right + up + down + 2) // 4
    colors = np.empty((*raw.shape, 3), raw.dtype.newbyteorder("="))
    for index, own in enumerate(pattern):
        row, column = divmod(index, 2)
        at = (slice(row, None, 2), slice(column, None, 2))
        target = colors[at]
        target[:, :, "rgb".index(own)] = raw[at]
        if own == "g":
            target[:, :, "rgb".index(pattern[2 * row + 1 - column])] = across[at]
            target[:, :, "rgb".index(pattern[2 * (1 - row) + column])] = along[at]
        else:
            target[:, :, 1] = cross[at]
            target[:, :, 2 - "rgb".index(own)] = corners[at]
    return colors


def _from_yuv422(samples: Pixels, brightness: int) -> Pixels:
    """Return the colors of (height, width, 2) samples: two pixels share U and V; `brightness` is the index of Y."""
    height, width, _ = samples.shape
    chroma = samples[:, :, 1 - brightness].reshape(height, width // 2, 2)
    return _from_yuv(samples[:, :, brightness], chroma.repeat(2, axis=1))


def _from_nv(samples: Pixels, height: int, kind: str) -> Pixels:
    """Return the colors of rows of Y, followed by rows of U and V (V and U for NV21)."""
    width = samples.shape[1]
    bright, colors = samples[:height], np.ascontiguousarray(samples[height:])
    if kind == "NV24":
        return _from_yuv(bright, colors.reshape(height, width, 2))
    if height % 2:
        raise DecodeError(f"a {kind.lower()} image of {width} x {height} pixels must have an even size")
    chroma = colors.reshape(height // 2, width // 2, 2).repeat(2, axis=0).repeat(2, axis=1)
    return _from_yuv(bright, chroma if kind == "NV12" else chroma[:, :, ::-1])


def _from_yuv(bright: Pixels, chroma: Pixels) -> Pixels:
    """Return the colors of Y, (height, width), and U and V, (height, width, 2), by ITU-R BT.601 as in OpenCV."""
    y = 1.164383 * np.maximum(bright.astype(np.float32) - 16.0, 0.0)
    u, v = (chroma[:, :, index].astype(np.float32) - 128.0 for index in (0, 1))
    colors = np.stack([y + 1.596027 * v, y - 0.812968 * v - 0.391762 * u, y + 2.017232 * u], axis=-1)
    rounded: Pixels = (np.clip(colors, 0.0, 255.0) + 0.5).astype(np.uint8)
    return rounded
