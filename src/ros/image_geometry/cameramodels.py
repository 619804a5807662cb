# SPDX-License-Identifier: Apache-2.0
"""Pinhole and stereo cameras.

The lens is that of the CameraInfo's `distortion_model`, as in the C++ library; upstream's Python module ignores it.

The methods have the names of Humble (`project3dToPixel`) and of newer distributions (`project_3d_to_pixel`).
Matrices are `numpy.matrix`, as upstream, so that `*` is the matrix product. Pixels are (column, row); points are in the
optical frame of the camera (x to the right, y down, z forward) in meters.
"""

import copy
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coframe._process.optional_imports import import_optional
from coframe.cameras import CameraModel, lens_of
from sensor_msgs.msg import CameraInfo

__all__ = ["PinholeCameraModel", "StereoCameraModel"]

Matrix = Any  # numpy.matrix, which has no type arguments that all supported versions of NumPy agree on.
Numbers = Sequence[float] | NDArray[np.float64]


def _matrix(rows: int, columns: int, values: Any) -> Matrix:
    return np.asmatrix(np.array(values, np.float64).reshape(rows, columns))


def _element(matrix: Matrix, row: int, column: int) -> float:
    """Return an element as `numpy.float64`, so that division by zero is not an error: P may be all zeros."""
    element: float = matrix[row, column]
    return element


def _opencv() -> Any:
    return import_optional("cv2", "Rectification by image_geometry", "opencv")


class PinholeCameraModel:
    """A calibrated camera with a lens.

    All attributes are None before `fromCameraInfo`.

    Attributes:
        K: Intrinsic matrix of the raw image, shape (3, 3), for the binning and region of interest of the image.
        D: Coefficients of the distortion, shape (N, 1), or None without distortion.
        R: Rotation into the rectified frame, shape (3, 3).
        P: Projection matrix of the rectified image, shape (3, 4), for the binning and region of interest of the image.
        full_K: K of the full resolution.
        full_P: P of the full resolution.
        width: Width of the full image in pixels.
        height: Height of the full image in pixels.
        binning_x: Pixels that are combined along a row.
        binning_y: Pixels that are combined along a column.
        resolution: (width, height).
        raw_roi: Region of interest of the raw image at full resolution.
        tf_frame: Optical frame of the camera.
        stamp: Stamp of the CameraInfo message.
    """

    def __init__(self) -> None:
        self.K: Matrix = None
        self.D: Matrix = None
        self.R: Matrix = None
        self.P: Matrix = None
        self.full_K: Matrix = None
        self.full_P: Matrix = None
        self.width: Any = None
        self.height: Any = None
        self.binning_x: Any = None
        self.binning_y: Any = None
        self.resolution: Any = None
        self.raw_roi: Any = None
        self.tf_frame: Any = None
        self.stamp: Any = None
        self.__distortion_model = ""

    def fromCameraInfo(self, msg: CameraInfo) -> None:
        """Use the calibration in a CameraInfo message."""
        self.__distortion_model = msg.distortion_model
        self.K, self.full_K = _matrix(3, 3, msg.k), _matrix(3, 3, msg.k)
        self.D = _matrix(len(msg.d), 1, msg.d) if len(msg.d) else None
        self.R = _matrix(3, 3, msg.r)
        self.P, self.full_P = _matrix(3, 4, msg.p), _matrix(3, 4, msg.p)
        self.width, self.height = msg.width, msg.height
        self.resolution = (msg.width, msg.height)
        self.binning_x, self.binning_y = max(1, msg.binning_x), max(1, msg.binning_y)
        self.raw_roi = copy.copy(msg.roi)
        if not (msg.roi.x_offset or msg.roi.y_offset or msg.roi.width or msg.roi.height):
            self.raw_roi.width, self.raw_roi.height = msg.width, msg.height
        self.tf_frame, self.stamp = msg.header.frame_id, msg.header.stamp
        for matrix in (self.K, self.P):
            matrix[0, 0] /= self.binning_x
            matrix[1, 1] /= self.binning_y
            matrix[0, 2] = (matrix[0, 2] - self.raw_roi.x_offset) / self.binning_x
            matrix[1, 2] = (matrix[1, 2] - self.raw_roi.y_offset) / self.binning_y

    def rectifyImage(self, raw: NDArray[Any], rectified: NDArray[Any]) -> None:
        """Remove the distortion of an image.

        Args:
            raw: The image, shape (height, width[, channels]).
            rectified: Array of the same shape and type into which the result is written.

        Raises:
            CameraError: The distortion model is not supported.
            ModuleNotFoundError: OpenCV is not installed.
        """
        cv2 = _opencv()
        size = (raw.shape[1], raw.shape[0])
        self.mapx, self.mapy = self.__camera().undistortion_map(size)
        cv2.remap(raw, self.mapx, self.mapy, cv2.INTER_CUBIC, rectified)

    def rectifyPoint(self, uv_raw: Numbers) -> NDArray[np.float64]:
        """Return the pixel of the rectified image for a pixel of the raw image, NaN if the lens draws nothing there.

        Raises:
            CameraError: The distortion model is not supported.
        """
        return self.__camera().rectify(np.array(uv_raw, np.float64).reshape(2))

    def __camera(self) -> CameraModel:
        """Return the camera of the current matrices, which programs may have set."""
        coefficients = [] if self.D is None else np.asarray(self.D).ravel().tolist()
        lens = lens_of(self.__distortion_model, coefficients)
        return CameraModel(self.width, self.height, np.asarray(self.K), lens, np.asarray(self.R), np.asarray(self.P))

    def project3dToPixel(self, point: Numbers) -> tuple[float, float]:
        """Return the pixel (u, v) of the rectified image for a point (x, y, z), NaN if the point is in the camera."""
        x, y, w = (self.P * _matrix(4, 1, [point[0], point[1], point[2], 1.0])).A1.tolist()
        return (x / w, y / w) if w != 0 else (math.nan, math.nan)

    def projectPixelTo3dRay(self, uv: Numbers) -> tuple[float, float, float]:
        """Return the unit vector from the camera through a pixel (u, v) of the rectified image."""
        x = (uv[0] - self.cx()) / self.fx()
        y = (uv[1] - self.cy()) / self.fy()
        length = math.sqrt(x * x + y * y + 1.0)
        return x / length, y / length, 1.0 / length

    def getDeltaU(self, deltaX: float, Z: float) -> float:
        """Return the difference of u for a difference of x at distance Z."""
        return math.inf if Z == 0 else self.fx() * deltaX / Z

    def getDeltaV(self, deltaY: float, Z: float) -> float:
        """Return the difference of v for a difference of y at distance Z."""
        return math.inf if Z == 0 else self.fy() * deltaY / Z

    def getDeltaX(self, deltaU: float, Z: float) -> float:
        """Return the difference of x for a difference of u at distance Z."""
        return Z * deltaU / self.fx()

    def getDeltaY(self, deltaV: float, Z: float) -> float:
        """Return the difference of y for a difference of v at distance Z."""
        return Z * deltaV / self.fy()

    def fullResolution(self) -> Any:
        """Return the full resolution (width, height)."""
        return self.resolution

    def intrinsicMatrix(self) -> Matrix:
        """Return the intrinsic matrix of the raw image."""
        return self.K

    def distortionCoeffs(self) -> Matrix:
        """Return the coefficients of the distortion."""
        return self.D

    def rotationMatrix(self) -> Matrix:
        """Return the rotation into the rectified frame."""
        return self.R

    def projectionMatrix(self) -> Matrix:
        """Return the projection matrix of the rectified image."""
        return self.P

    def fullIntrinsicMatrix(self) -> Matrix:
        """Return the intrinsic matrix of the full resolution."""
        return self.full_K

    def fullProjectionMatrix(self) -> Matrix:
        """Return the projection matrix of the full resolution."""
        return self.full_P

    def cx(self) -> float:
        """Return the column of the principal point."""
        return _element(self.P, 0, 2)

    def cy(self) -> float:
        """Return the row of the principal point."""
        return _element(self.P, 1, 2)

    def fx(self) -> float:
        """Return the focal length in columns."""
        return _element(self.P, 0, 0)

    def fy(self) -> float:
        """Return the focal length in rows."""
        return _element(self.P, 1, 1)

    def Tx(self) -> float:
        """Return the translation of the projection along x."""
        return _element(self.P, 0, 3)

    def Ty(self) -> float:
        """Return the translation of the projection along y."""
        return _element(self.P, 1, 3)

    def fovX(self) -> float:
        """Return the horizontal field of view in radians."""
        return 2.0 * math.atan(self.width / (2.0 * self.fx()))

    def fovY(self) -> float:
        """Return the vertical field of view in radians."""
        return 2.0 * math.atan(self.height / (2.0 * self.fy()))

    def tfFrame(self) -> Any:
        """Return the optical frame of the camera."""
        return self.tf_frame

    from_camera_info = fromCameraInfo
    rectify_image = rectifyImage
    rectify_point = rectifyPoint
    project_3d_to_pixel = project3dToPixel
    project_pixel_to_3d_ray = projectPixelTo3dRay
    get_delta_u = getDeltaU
    get_delta_v = getDeltaV
    get_delta_x = getDeltaX
    get_delta_y = getDeltaY
    full_resolution = fullResolution
    intrinsic_matrix = intrinsicMatrix
    distortion_coeffs = distortionCoeffs
    rotation_matrix = rotationMatrix
    projection_matrix = projectionMatrix
    full_intrinsic_matrix = fullIntrinsicMatrix
    full_projection_matrix = fullProjectionMatrix
    tx = Tx
    ty = Ty
    fov_x = fovX
    fov_y = fovY
    get_tf_frame = tfFrame


class StereoCameraModel:
    """Two calibrated cameras with parallel image planes.

    Attributes:
        left: The left camera, in whose frame all points are expressed.
        right: The right camera.
        Q: Matrix that turns (u, v, disparity, 1) into a homogeneous point, shape (4, 4).
    """

    def __init__(self) -> None:
        self.left = PinholeCameraModel()
        self.right = PinholeCameraModel()
        self.Q: Matrix = None

    def fromCameraInfo(self, left_msg: CameraInfo, right_msg: CameraInfo) -> None:
        """Use the calibrations in two CameraInfo messages."""
        self.left.fromCameraInfo(left_msg)
        self.right.fromCameraInfo(right_msg)
        fx, cx, cy = self.right.fx(), self.right.cx(), self.right.cy()
        baseline = -self.right.Tx() / fx
        self.Q = _matrix(4, 4, np.zeros((4, 4)))
        self.Q[0, 0] = self.Q[1, 1] = 1.0
        self.Q[0, 3], self.Q[1, 3], self.Q[2, 3] = -cx, -cy, fx
        self.Q[3, 2] = 1.0 / baseline

    def tfFrame(self) -> Any:
        """Return the optical frame of the left camera."""
        return self.left.tfFrame()

    def project3dToPixel(self, point: Numbers) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return the pixels (u, v) of a point (x, y, z) in the left and right rectified image."""
        return self.left.project3dToPixel(point), self.right.project3dToPixel(point)

    def projectPixelTo3d(self, left_uv: Numbers, disparity: float) -> tuple[float, float, float]:
        """Return the point (x, y, z) of a pixel in the left rectified image, (0, 0, 0) if the disparity is 0.

        Args:
            left_uv: The pixel (u, v).
            disparity: The number of columns by which the point is further left in the right image.
        """
        x, y, z, w = (self.Q * _matrix(4, 1, [left_uv[0], left_uv[1], disparity, 1.0])).A1.tolist()
        return (x / w, y / w, z / w) if w != 0 else (0.0, 0.0, 0.0)

    def getZ(self, disparity: float) -> float:
        """Return the distance for a disparity."""
        return math.inf if disparity == 0 else -self.right.Tx() / disparity

    def getDisparity(self, Z: float) -> float:
        """Return the disparity for a distance."""
        return math.inf if Z == 0 else -self.right.Tx() / Z

    from_camera_info = fromCameraInfo
    get_tf_frame = tfFrame
    project_3d_to_pixel = project3dToPixel
    project_pixel_to_3d = projectPixelTo3d
    get_z = getZ
    get_disparity = getDisparity
