# SPDX-License-Identifier: Apache-2.0
"""Types of OpenCV for the encodings of images, and the conversion between encodings."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from coframe.sensors import encodings
from cv_bridge._conversion import convert

__all__ = ["CV_MAT_CNWrap", "CV_MAT_DEPTHWrap", "cvtColor2", "cvtColorForDisplay", "getCvType"]

Image = NDArray[Any]


def getCvType(encoding: str) -> int:
    """Return the number of OpenCV's type for an encoding, such as cv2.CV_8UC3 for "bgr8".

    Raises:
        RuntimeError: There is no such encoding.
    """
    return encodings.cv_type(encodings.find(encoding))


def CV_MAT_CNWrap(i: int) -> int:
    """Return the channels of a type of OpenCV."""
    return ((i >> 3) & 511) + 1


def CV_MAT_DEPTHWrap(i: int) -> int:
    """Return the depth of a type of OpenCV."""
    return i & 7


def cvtColor2(obj_in: Image, encoding_in: str, encoding_out: str) -> Image:
    """Convert an image to another encoding.

    Args:
        obj_in: Image, shape (height, width) or (height, width, channels).
        encoding_in: Encoding of the image.
        encoding_out: Encoding of the result.

    Raises:
        RuntimeError: There is no such encoding, or no conversion.
        ModuleNotFoundError: OpenCV is not installed.
    """
    return convert(obj_in, encoding_in, encoding_out)


def cvtColorForDisplay(
    obj_in: Image,
    encoding_in: str,
    encoding_out: str,
    do_dynamic_scaling: bool = False,
    min_image_value: float = 0.0,
    max_image_value: float = 0.0,
) -> Image:
    """Convert an image of any encoding to one that can be shown.

    Args:
        obj_in: Image, shape (height, width) or (height, width, channels).
        encoding_in: Encoding of the image.
        encoding_out: "mono8", "bgr8" or another encoding of colors. "": mono8 for one channel, bgr8 for colors.
        do_dynamic_scaling: Whether to scale the values of one channel to the range of the result.
        min_image_value: Value that is shown black.
        max_image_value: Value that is shown white. If it equals `min_image_value`, the range of the image is used.

    Raises:
        RuntimeError: There is no such encoding, or no conversion.
        ModuleNotFoundError: OpenCV is not installed.
    """
    encoding = encodings.find(encoding_in)
    gray = encoding.channels == 1 and encoding.colors in {"", "GRAY"}
    encoding_out = encoding_out or ("mono8" if gray else "bgr8")
    if do_dynamic_scaling:
        if encoding.channels != 1:
            raise RuntimeError("cvtColorForDisplay() dynamic scaling is only possible for single-channel images")
        return convert(_scale(obj_in, min_image_value, max_image_value), "mono8", encoding_out)
    if not encoding.colors:
        named = {1: "mono", 3: "bgr", 4: "bgra"}.get(encoding.channels)
        if named is None or encoding.dtype not in {"uint8", "uint16"}:
            raise RuntimeError(f"cvtColorForDisplay() [{encoding_in}] needs dynamic scaling or another encoding")
        encoding_in = f"{named}{encoding.bits}"
    return convert(obj_in, encoding_in, encoding_out)


def _scale(image: Image, low: float, high: float) -> NDArray[np.uint8]:
    """Return the values from `low` to `high` as 0 to 255. Values that are not finite are 0."""
    values = image.astype(np.float64)
    finite = np.isfinite(values)
    if low == high and finite.any():
        low, high = float(values[finite].min()), float(values[finite].max())
    if low == high:
        return np.zeros(image.shape, np.uint8)
    shades = np.rint((values - low) * (255.0 / (high - low)))
    return np.where(finite, np.clip(np.nan_to_num(shades), 0, 255), 0).astype(np.uint8)
