# SPDX-License-Identifier: Apache-2.0
"""CameraModel: the projection of a calibrated camera, from a CameraInfo message."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe._process.optional_imports import import_optional
from coframe.cameras.lenses import PolynomialLens
from coframe.cameras.model_names import lens_of
from coframe.errors import CameraError
from coframe.time import stamp_ns

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike, NDArray

    from coframe.cameras.lenses import Lens
    from coframe.time import StampLike
    from coframe.transform.transform import Transform

    Array = NDArray[np.float64]

__all__ = ["CameraModel", "RegionOfInterest"]

MAX_IMAGE_SIDE = 1 << 16  # pixels
_ROLLING_STEPS = 10
_OUTSIDE_PIXEL = -1e4  # pixels
_MAX_ROLLING_ERROR = 0.05  # pixels between the last two steps


class RegionOfInterest(NamedTuple):
    """The part of the image that the camera sends, in pixels of the full image; all zero for the full image."""

    x_offset: int = 0
    y_offset: int = 0
    width: int = 0
    height: int = 0


@dataclass(frozen=True, eq=False)
class CameraModel:
    """A calibrated camera. Pixels are (column, row); the center of the upper left pixel is (0, 0).

    Points are in the optical frame of the camera (REP 103): x to the right, y down, z forward, in meters.

    Attributes:
        width: Width of the full image in pixels.
        height: Height of the full image in pixels.
        k: Intrinsic matrix of the raw full image, shape (3, 3).
        lens: The lens, which distorts the raw image.
        r: Rotation from the optical frame into the rectified frame, shape (3, 3).
        p: Projection matrix of the rectified full image, shape (3, 4).
        frame: Optical frame of the camera.
        binning: Pixels that are combined along a row and along a column.
        roi: The part of the full image that the camera sends.

    Example:
        >>> from coframe.messages import find
        >>> info = find("sensor_msgs/msg/CameraInfo")(width=1280, height=800, distortion_model="equidistant")
        >>> info.k = [400.0, 0.0, 640.0, 0.0, 400.0, 400.0, 0.0, 0.0, 1.0]
        >>> camera = CameraModel.from_info(info)
        >>> camera.project([3.0, 0.0, 2.0]).round(1).tolist()
        [1033.1, 400.0]
    """

    width: int
    height: int
    k: Array
    lens: Lens = field(default_factory=PolynomialLens)
    r: Array = field(default_factory=lambda: np.eye(3))
    p: Array = field(default_factory=lambda: np.zeros((3, 4)))
    frame: str = ""
    binning: tuple[int, int] = (1, 1)
    roi: RegionOfInterest = field(default_factory=RegionOfInterest)

    def __post_init__(self) -> None:
        for name, shape in (("k", (3, 3)), ("r", (3, 3)), ("p", (3, 4))):
            matrix = np.array(getattr(self, name), np.float64)
            if matrix.shape != shape:
                raise CameraError(f"the matrix {name.upper()} of a camera has the shape {matrix.shape}, not {shape}")
            if name == "r" and not matrix.any():
                matrix = np.eye(3)
            if name == "p" and not matrix.any():
                matrix = np.column_stack([self.k, np.zeros(3)])
            matrix.setflags(write=False)
            object.__setattr__(self, name, matrix)
        if not (0 <= self.width <= MAX_IMAGE_SIDE and 0 <= self.height <= MAX_IMAGE_SIDE):
            raise CameraError(
                f"an image of {self.width} x {self.height} pixels is not possible: the limit is {MAX_IMAGE_SIDE}"
            )

    @classmethod
    def from_info(cls, info: Any) -> CameraModel:
        """Return the camera of a sensor_msgs/CameraInfo message, of ROS 2 or ROS 1.

        Raises:
            CameraError: The distortion model is not supported or does not fit its coefficients, or the message contains
                no calibration.
        """
        names = "kdrp" if hasattr(info, "k") else "KDRP"  # ROS 1 has upper-case names
        k, d, r, p = (getattr(info, name) for name in names)
        k, p = np.asarray(k, np.float64), np.asarray(p, np.float64)
        if not (k.size == 9 and (k[[0, 4]] > 0.0).all()) and not (p.size == 12 and (p[[0, 5]] > 0.0).all()):
            raise CameraError(
                "the CameraInfo contains no calibration: fx and fy of K or P must be positive",
                hint="Calibrate the camera, and load the file with its driver (camera_info_url).",
            )
        roi = info.roi
        return cls(
            int(info.width),
            int(info.height),
            k.reshape(3, 3),
            lens_of(info.distortion_model, list(d)),
            np.reshape(np.asarray(r, np.float64), (3, 3)),
            p.reshape(3, 4),
            info.header.frame_id,
            (max(1, int(info.binning_x)), max(1, int(info.binning_y))),
            RegionOfInterest(int(roi.x_offset), int(roi.y_offset), int(roi.width), int(roi.height)),
        )

    @property
    def image_size(self) -> tuple[int, int]:
        """The size of the image that the camera sends, (width, height), after region of interest and binning."""
        width, height = (self.roi.width, self.roi.height) if any(self.roi) else (self.width, self.height)
        return width // self.binning[0], height // self.binning[1]

    @property
    def baseline(self) -> tuple[float, float]:
        """The position of this camera in the frame of the first camera of its pair, by P: x and y in meters."""
        return -float(self.p[0, 3] / self.p[0, 0]), -float(self.p[1, 3] / self.p[1, 1])

    def without_baseline(self) -> CameraModel:
        """Return the camera for points in its own frame, if the transforms contain the baseline, too."""
        p = self.p.copy()
        p[:2, 3] = 0.0
        return replace(self, p=p)

    def project(self, points: ArrayLike, *, rectified: bool = False) -> Array:
        """Return the pixels of points.

        Args:
            points: Points in the optical frame, shape (..., 3).
            rectified: Use the rectified image instead of the raw one. The fourth column of P then moves the points from
                the frame of the first camera of a stereo pair; see :meth:`without_baseline`.

        Returns:
            Pixels of the image that the camera sends, shape (..., 2): NaN for points that the lens cannot see. Pixels
            outside the image are returned as well: see :meth:`contains`.

        Raises:
            CameraError: The camera has no calibration for this image.
        """
        rows, shape = _rows(points, 3)
        if rectified:
            full = _to_homogeneous(rows @ self.r.T @ self._check_matrix(self.p, "P")[:, :3].T + self.p[:, 3])
        else:
            k = self._check_matrix(self.k, "K")
            full = self.lens.distort(rows) @ k[:2, :2].T + k[:2, 2]
        return ((full - self._offset) / self.binning).reshape(*shape, 2)

    def rays(self, pixels: ArrayLike, *, rectified: bool = False) -> Array:
        """Return the unit vectors from the camera through pixels, in its optical frame.

        Args:
            pixels: Pixels of the image that the camera sends, shape (..., 2).
            rectified: Whether they are pixels of the rectified image.

        Returns:
            Unit vectors, shape (..., 3): NaN for pixels to which the lens draws nothing.

        Raises:
            CameraError: The camera has no calibration for this image.
        """
        rows, shape = _rows(pixels, 2)
        full = rows * self.binning + self._offset
        if rectified:
            ahead = (
                np.column_stack([full, np.ones(len(full))]) @ np.linalg.inv(self._check_matrix(self.p, "P")[:, :3]).T
            )
            found = ahead @ self.r
            found = found / np.linalg.norm(found, axis=1, keepdims=True)
        else:
            k = self._check_matrix(self.k, "K")
            found = self.lens.rays((full - k[:2, 2]) @ np.linalg.inv(k[:2, :2]).T)
        return np.asarray(found.reshape(*shape, 3))

    def rectify(self, pixels: ArrayLike) -> Array:
        """Return the pixels of the rectified image for pixels of the raw image, shape (..., 2)."""
        rows, shape = _rows(pixels, 2)
        return self.without_baseline().project(self.rays(rows), rectified=True).reshape(*shape, 2)

    def contains(self, pixels: ArrayLike) -> NDArray[np.bool_]:
        """Return which pixels (..., 2) are inside the image that the camera sends."""
        at = np.asarray(pixels, np.float64)
        return np.asarray(((at >= -0.5) & (at < np.array(self.image_size) - 0.5)).all(axis=-1))

    def undistort(self, image: NDArray[Any]) -> NDArray[Any]:
        """Return the rectified image of a raw image.

        Args:
            image: Raw image, shape (height, width[, channels]) as in :attr:`image_size`.

        Raises:
            ModuleNotFoundError: OpenCV is not installed.
            ValueError: The image has another size.
        """
        cv2 = import_optional("cv2", "Undistorting images", "opencv")
        if image.shape[1::-1] != self.image_size:
            width, height = image.shape[1::-1]
            raise ValueError(f"an image of {width} x {height} pixels; the camera sends {self.image_size}")
        columns, rows = self._undistortion_map
        return np.asarray(cv2.remap(image, columns, rows, cv2.INTER_CUBIC))

    @cached_property
    def _undistortion_map(self) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        return self.undistortion_map(self.image_size)

    def undistortion_map(self, size: tuple[int, int]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Return the column and the row in the raw image for each pixel of a rectified image of a size (width, height).

        They are arrays for ``cv2.remap``, shape (height, width). Pixels that the camera does not see are far outside.
        """
        pixels = np.stack(np.meshgrid(np.arange(size[0]), np.arange(size[1])), axis=-1)
        raw = np.nan_to_num(self.project(self.rays(pixels, rectified=True)), nan=_OUTSIDE_PIXEL).astype(np.float32)
        return np.ascontiguousarray(raw[..., 0]), np.ascontiguousarray(raw[..., 1])

    def project_rolling(
        self,
        points: ArrayLike,
        pose_at: Callable[[NDArray[np.int64]], Transform],
        *,
        stamp: StampLike,
        readout: int,
        rectified: bool = False,
    ) -> Array:
        """Return the pixels of points for a rolling shutter, which exposes each row at its own time.

        Args:
            points: Points in a frame that does not move, shape (N, 3).
            pose_at: Returns the transforms from that frame to the optical frame at int64 times in nanoseconds, shape
                (N,): ``lambda times: buffer.lookup_many("camera_optical_frame", "map", times)``.
            stamp: Time of the first row.
            readout: Time from the first to the last row in nanoseconds; negative if the last row is exposed first.
            rectified: As for :meth:`project`.

        Returns:
            Pixels, shape (N, 2): NaN for points that the camera cannot see, and for those whose row is not unique,
            because the camera turns as quickly as it reads its rows.
        """
        flat, _ = _rows(points, 3)
        height = max(self.image_size[1] - 1, 1)
        start = stamp_ns(stamp) - min(readout, 0)
        rows, pixels = np.full(len(flat), height / 2.0), np.full((len(flat), 2), np.nan)
        for _ in range(_ROLLING_STEPS):
            times = start + np.rint(np.clip(rows, 0, height) / height * readout).astype(np.int64)
            before = pixels
            pixels = self.project(pose_at(times).transform_point(flat), rectified=rectified)
            rows = np.where(np.isnan(pixels[:, 1]), rows, pixels[:, 1])
        with np.errstate(invalid="ignore"):
            pixels[~(np.abs(pixels - before).max(axis=1) < _MAX_ROLLING_ERROR)] = np.nan
        return pixels

    @property
    def _offset(self) -> Array:
        return np.array([self.roi.x_offset, self.roi.y_offset], np.float64)

    def _check_matrix(self, matrix: Array, name: str) -> Array:
        if not (np.isfinite(matrix).all() and matrix[0, 0] > 0.0 and matrix[1, 1] > 0.0):
            raise CameraError(f"the camera has no calibration for this image: fx and fy of {name} must be positive")
        return matrix


def _rows(values: ArrayLike, size: int) -> tuple[Array, tuple[int, ...]]:
    """Return vectors as rows, and the shape in front of them."""
    array = np.asarray(values, np.float64)
    if array.ndim == 0 or array.shape[-1] != size:
        raise ValueError(f"expected an array of shape (..., {size}), not {array.shape}")
    return array.reshape(-1, size), array.shape[:-1]


def _to_homogeneous(vectors: Array) -> Array:
    """Return places of the image plane, NaN for points that are not in front of it."""
    with np.errstate(all="ignore"):
        return np.where(vectors[:, 2:] > 0.0, vectors[:, :2] / vectors[:, 2:], np.nan)
