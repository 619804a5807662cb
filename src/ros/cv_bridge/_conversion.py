# SPDX-License-Identifier: Apache-2.0
"""Conversion of images between encodings, by the rules of upstream's C++ code and with its error messages."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from coframe._process.optional_imports import import_optional
from coframe.sensors.encodings import Encoding, find

Image = NDArray[Any]

_PLAIN_COLORS = {"GRAY", "RGB", "BGR", "RGBA", "BGRA"}


def opencv(purpose: str) -> Any:
    """Return the module cv2.

    Raises:
        ModuleNotFoundError: OpenCV is not installed.
    """
    return import_optional("cv2", purpose, "opencv")


def convert(image: Image, source: str, target: str) -> Image:
    """Convert an image to another encoding.

    Args:
        image: Image, shape (height, width) or (height, width, channels).
        source: Encoding of the image.
        target: Encoding of the result. The encoding of the image or "": the image itself is returned.

    Raises:
        RuntimeError: There is no such encoding, or no conversion.
        ModuleNotFoundError: OpenCV is not installed.
    """
    before = find(source)
    if target in {"", source}:
        return image
    after = find(target)
    if not before.colors or not after.colors:
        _check_channels(before, after, source, target)
        return _with_depth(image, before, after)
    if before.colors == after.colors:
        if before.colors not in _PLAIN_COLORS and before != after:
            raise RuntimeError(f"Unsupported conversion from [{source}] to [{target}]")
        return _with_depth(image, before, after)
    return _with_depth(_convert_color(image, before.colors, after.colors, source, target), before, after)


def _check_channels(before: Encoding, after: Encoding, source: str, target: str) -> None:
    if not before.colors and after.colors:
        raise RuntimeError(f"[{source}] is not a color format. but [{target}] is. The conversion does not make sense")
    if before.channels == after.channels:
        return
    if before.colors:
        raise RuntimeError(
            f"[{source}] is a color format but [{target}] is not so they must have the same OpenCV type, "
            "CV_8UC3, CV16UC1 ...."
        )
    raise RuntimeError(f"[{source}] and [{target}] do not have the same number of channel")


def _convert_color(image: Image, before: str, after: str, source: str, target: str) -> Image:
    if after not in _PLAIN_COLORS or (before.startswith("Bayer") and len(after) == 4 and after != "GRAY"):
        raise RuntimeError(f"Unsupported conversion from [{source}] to [{target}]")
    cv2 = opencv("The conversion of colors by cv_bridge")
    if before in _PLAIN_COLORS or before.startswith("Bayer"):
        code = getattr(cv2, f"COLOR_{before}2{after}")
    elif before == "NV24":
        return _from_nv24(cv2, image, after)
    else:
        code = getattr(cv2, f"COLOR_YUV2{after}_{before}")
    try:
        recolored: Image = cv2.cvtColor(image, code)
    except cv2.error as error:  # For example an image whose shape is not that of its encoding.
        raise RuntimeError(f"OpenCV cannot convert from [{source}] to [{target}]: {error}") from error
    return recolored


def _from_nv24(cv2: Any, image: Image, after: str) -> Image:
    """Convert NV24, which OpenCV does not support: it is NV12 of an image with doubled rows and columns."""
    height = image.shape[0] // 3
    brightness = image[:height]
    if after == "GRAY":
        return np.array(brightness)
    doubled = brightness.repeat(2, axis=0).repeat(2, axis=1)
    colors = image[height:].reshape(height, -1)
    recolored: Image = cv2.cvtColor(np.vstack([doubled, colors]), getattr(cv2, f"COLOR_YUV2{after}_NV12"))
    return np.ascontiguousarray(recolored[::2, ::2])


def _with_depth(image: Image, before: Encoding, after: Encoding) -> Image:
    """Return an image with values of another type, as OpenCV's `convertTo`: 8 and 16 bits are scaled to each other."""
    if before.depth == after.depth:
        return image
    if (before.bits, after.bits) == (8, 16):
        return _saturate(image * (65535.0 / 255.0), after.dtype)
    if (before.bits, after.bits) == (16, 8):
        return _saturate(image * (255.0 / 65535.0), after.dtype)
    return _saturate(image, after.dtype)


def _saturate(image: Image, dtype: str) -> Image:
    """Return the values as another type. Integers are rounded to even and limited to the range of the type."""
    if np.issubdtype(dtype, np.floating):
        return image.astype(dtype)
    limits = np.iinfo(dtype)
    low, high = int(limits.min), int(limits.max)
    if np.issubdtype(image.dtype, np.floating):
        # float32 has no number for the largest int32.
        image = np.nan_to_num(np.rint(image.astype(np.float64)), nan=low, posinf=high, neginf=low)
    else:
        own = np.iinfo(image.dtype)
        low, high = max(low, int(own.min)), min(high, int(own.max))
    return np.clip(image, low, high).astype(dtype)
