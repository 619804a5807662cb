# SPDX-License-Identifier: Apache-2.0
"""Convert depth images to points."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.errors import CameraError, DecodeError
from coframe.sensors.depth_images import decode_compressed_depth
from coframe.sensors.image_pixels import decode_image

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.cameras import CameraModel

__all__ = ["decode_depths", "depth_points"]

_MILLIMETER = 0.001  # the unit of depth images of integers, by REP 118


def decode_depths(image: Any) -> NDArray[np.float32]:
    """Return the depths in an Image (16UC1, mono16, 32FC1) or a CompressedImage (compressedDepth).

    Returns:
        Meters, shape (height, width); NaN where there is no measurement.

    Raises:
        DecodeError: The message contains no depths, or is incomplete.
    """
    values = decode_compressed_depth(image) if hasattr(image, "format") else decode_image(image)
    if values.ndim != 2 or values.dtype == np.uint8:
        kind = getattr(image, "encoding", "") or getattr(image, "format", "")
        raise DecodeError(f"{kind[:40]!r} is not an encoding of depths. Depth images are 16UC1 or 32FC1")
    if values.dtype == np.float32:
        return values
    depths: NDArray[np.float32] = (values * np.float32(_MILLIMETER)).astype(np.float32)
    depths[values == 0] = np.nan
    return depths


def depth_points(
    depths: NDArray[Any], camera: CameraModel, *, rectified: bool = False, step: int = 1
) -> NDArray[np.float64]:
    """Return the points of a depth image in the optical frame of its camera.

    Args:
        depths: Meters along the optical axis, shape (height, width).
        camera: The camera that took the image.
        rectified: Whether the image is the rectified one. Otherwise, each ray is bent by the lens.
        step: Use only every n-th row and column.

    Returns:
        Meters, shape (height, width, 3), or fewer rows and columns; NaN where there is no depth, or where the lens
        draws nothing.

    Raises:
        CameraError: The image has another size than those of the camera, or the camera has no calibration for it.

    Example:
        >>> from coframe.cameras import CameraModel
        >>> camera = CameraModel(2, 1, [[1, 0, 0.5], [0, 1, 0], [0, 0, 1]])
        >>> depth_points(np.array([[2.0, 4.0]]), camera).tolist()
        [[[-1.0, 0.0, 2.0], [2.0, 0.0, 4.0]]]
    """
    if depths.shape[::-1] != camera.image_size:
        sizes = [f"{width} x {height}" for width, height in (depths.shape[::-1], camera.image_size)]
        raise CameraError(
            f"the depth image has {sizes[0]} pixels, but its CameraInfo describes {sizes[1]}",
            hint="Use the CameraInfo that is published together with this image.",
        )
    sampled_depths = depths[::step, ::step]
    measured = np.where(np.isfinite(sampled_depths) & (sampled_depths > 0.0), sampled_depths, np.nan)
    width, height = camera.image_size
    pixels = np.stack(np.meshgrid(np.arange(0, width, step), np.arange(0, height, step)), axis=-1)
    rays = camera.rays(pixels, rectified=rectified)
    ahead = rays @ (camera.r[2] if rectified else np.array([0.0, 0.0, 1.0]))
    with np.errstate(all="ignore"):
        scale = measured / np.where(ahead > 0.0, ahead, np.nan)
    return np.asarray(rays * scale[..., None])
