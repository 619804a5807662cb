# SPDX-License-Identifier: Apache-2.0
"""Color points by the image of a camera that sees them.

A point is hidden if much nearer points surround it in the image: above and below, each to the left and to the right. On
a plane this cannot happen, however flat the camera looks at it, and at the edge of an object the points behind it stay
visible, because only one side is covered.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.errors import CameraError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from coframe.cameras.camera_model import CameraModel

    Array = NDArray[np.float64]

__all__ = ["PointColors", "color_points"]

_NEIGHBORS = 4  # distance up to which points hide another one, in usual distances between points of the image
_BLOCK = 16  # pixels of a square, to measure which part of the image has points
_MIN_STEP = 0.1  # meters by which a point must be nearer to hide another one
_MIN_SLOPE = 2.0  # the same, as a multiple of the distance across the view: nearer points may be of the same surface
_MIN_RANGE = 0.05  # meters


class PointColors(NamedTuple):
    """Colors of points.

    Attributes:
        colors: Red, green and blue as uint8, shape (N, 3); 0 for points without a color.
        visible: Which points are in the image and not hidden, shape (N,).
    """

    colors: NDArray[np.uint8]
    visible: NDArray[np.bool_]


def color_points(
    points: ArrayLike, image: NDArray[Any], camera: CameraModel, *, rectified: bool = False
) -> PointColors:
    """Return the colors that the pixels of an image have where points are.

    Args:
        points: Points in the optical frame of the camera at the time of the image, in meters, shape (N, 3). NaN is
            permitted.
        image: Brightness (height, width) or red, green, blue (height, width, 3), as uint8 or uint16.
        camera: The camera that took the image.
        rectified: Whether the image is the rectified one.

    Raises:
        CameraError: The image has another size than those of the camera, or the camera has no calibration for it.

    Example:
        >>> from coframe.cameras import CameraModel
        >>> camera = CameraModel(2, 1, [[1, 0, 0.5], [0, 1, 0], [0, 0, 1]])
        >>> image = np.array([[10, 200]], np.uint8)
        >>> color_points([[-0.5, 0, 1], [0.5, 0, 1], [9, 0, 1]], image, camera).colors.tolist()
        [[10, 10, 10], [200, 200, 200], [0, 0, 0]]
    """
    array = np.asarray(points, np.float64).reshape(-1, 3)
    if image.shape[1::-1] != camera.image_size:
        sizes = [f"{width} x {height}" for width, height in (image.shape[1::-1], camera.image_size)]
        raise CameraError(
            f"the image has {sizes[0]} pixels, but its CameraInfo describes {sizes[1]}",
            hint="Use the CameraInfo that is published together with this image.",
        )
    pixels = camera.project(array, rectified=rectified)
    distance = np.linalg.norm(array, axis=1)
    with np.errstate(invalid="ignore"):
        seen = np.flatnonzero(camera.contains(pixels) & (distance > _MIN_RANGE))
    inside = pixels[seen]
    visible = np.zeros(len(array), bool)
    visible[seen] = ~_is_hidden(inside, distance[seen], camera)
    columns, rows = np.rint(inside[visible[seen]]).astype(int).T
    colors = np.zeros((len(array), 3), np.uint8)
    chosen = image[rows, columns]
    if chosen.dtype == np.uint16:
        chosen = chosen >> 8
    colors[visible] = chosen if chosen.ndim == 2 else chosen[:, None]
    return PointColors(colors, visible)


def _is_hidden(pixels: Array, distance: Array, camera: CameraModel) -> NDArray[np.bool_]:
    """Return which of the points in an image are surrounded by points that are much nearer."""
    if not len(pixels):
        return np.zeros(0, bool)
    cell = _point_spacing(pixels)
    columns, rows = ((pixels + 0.5) / cell).astype(int).T
    grid = np.full((rows.max() + 1, columns.max() + 1), np.inf)
    np.minimum.at(grid, (rows, columns), distance)
    size = _NEIGHBORS
    padded = np.pad(grid, size, constant_values=np.inf)
    for axis in (0, 1):  # the nearest point of each window that begins at a cell
        padded = np.lib.stride_tricks.sliding_window_view(padded, size, axis).min(axis=-1)
    before, after = 0, size + 1  # first cells of the windows on both sides, after the padding
    surrounding = np.max(
        [padded[rows + down, columns + right] for down in (before, after) for right in (before, after)], axis=0
    )
    focal = float(camera.k[0, 0] or camera.p[0, 0]) / camera.binning[0]
    across = distance * size * cell / focal
    return np.asarray(surrounding < distance - np.maximum(_MIN_STEP, _MIN_SLOPE * across))


def _point_spacing(pixels: Array) -> float:
    """Return the usual distance between points in the part of the image that has points, at least one pixel."""
    blocks = np.unique((pixels // _BLOCK).astype(np.int64) @ np.array([1 << 20, 1]))
    return max(1.0, float(np.sqrt(len(blocks) * _BLOCK**2 / len(pixels))))
