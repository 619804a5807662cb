# SPDX-License-Identifier: Apache-2.0
"""image_geometry, compared with OpenCV."""

import math
import sys

import cv2
import numpy as np
import pytest

from coframe.cameras import CameraError
from image_geometry import PinholeCameraModel, StereoCameraModel
from sensor_msgs.msg import CameraInfo

pytestmark = pytest.mark.filterwarnings("ignore:the matrix subclass:PendingDeprecationWarning")

RAW = np.array([[500.0, 0.0, 320.0], [0.0, 510.0, 240.0], [0.0, 0.0, 1.0]])
DISTORTION = np.array([-0.2, 0.05, 0.001, -0.002, 0.01])
TURN = cv2.Rodrigues(np.array([0.01, -0.02, 0.03]))[0]
RECTIFIED = np.array([[480.0, 0.0, 310.0], [0.0, 480.0, 250.0], [0.0, 0.0, 1.0]])
POINT = (0.4, -0.3, 2.0)


def camera_info(baseline=0.0, **fields):
    info = CameraInfo(width=640, height=480, d=DISTORTION.tolist(), k=RAW.ravel(), r=TURN.ravel(), **fields)
    info.header.frame_id = "camera"
    info.p = np.column_stack([RECTIFIED, [-baseline * RECTIFIED[0, 0], 0.0, 0.0]]).ravel()
    return info


@pytest.fixture
def camera():
    model = PinholeCameraModel()
    model.fromCameraInfo(camera_info())
    return model


def test_points_are_projected_as_by_opencv(camera):
    expected, _ = cv2.projectPoints(np.array([POINT]), np.zeros(3), np.zeros(3), RECTIFIED, None)
    assert camera.project3dToPixel(POINT) == pytest.approx(expected.ravel())
    ray = camera.projectPixelTo3dRay(camera.project3dToPixel(POINT))
    assert ray == pytest.approx(np.array(POINT) / np.linalg.norm(POINT))
    assert all(math.isnan(value) for value in camera.project3dToPixel((1.0, 1.0, 0.0)))


def test_pixels_are_rectified_as_by_opencv(camera):
    # A point in the rectified frame, seen through the lens and found again.
    raw, _ = cv2.projectPoints(TURN.T @ np.array([POINT]).T, np.zeros(3), np.zeros(3), RAW, DISTORTION)
    assert camera.rectifyPoint(raw.ravel()) == pytest.approx(camera.project3dToPixel(POINT), abs=1e-3)


def test_images_are_rectified(camera):
    raw = cv2.GaussianBlur(np.random.default_rng(1).integers(0, 255, (480, 640), np.uint8), (0, 0), 4)
    rectified = np.zeros_like(raw)
    camera.rectifyImage(raw, rectified)
    for u, v in ((100, 200), (400, 300)):
        ray = np.array(camera.projectPixelTo3dRay((u, v)))
        seen, _ = cv2.projectPoints((TURN.T @ ray).reshape(1, 3), np.zeros(3), np.zeros(3), RAW, DISTORTION)
        expected = cv2.getRectSubPix(raw, (1, 1), tuple(seen.ravel().tolist()))
        assert rectified[v, u] == pytest.approx(int(expected[0, 0]), abs=2)


def test_sizes_at_a_distance(camera):
    assert (camera.getDeltaU(0.1, 2.0), camera.getDeltaV(0.1, 2.0)) == pytest.approx((24.0, 24.0))
    assert (camera.getDeltaX(24.0, 2.0), camera.getDeltaY(24.0, 2.0)) == pytest.approx((0.1, 0.1))
    assert camera.getDeltaU(1.0, 0.0) == camera.getDeltaV(1.0, 0.0) == math.inf
    fov_x, fov_y, *_ = cv2.calibrationMatrixValues(RECTIFIED, (640, 480), 1.0, 1.0)
    centered = camera.fovX(), camera.fovY()
    assert np.degrees(centered) == pytest.approx((fov_x, fov_y), abs=0.2)  # OpenCV considers the principal point.


def test_values_of_the_calibration(camera):
    assert (camera.fx(), camera.fy(), camera.cx(), camera.cy()) == (480.0, 480.0, 310.0, 250.0)
    assert (camera.Tx(), camera.Ty(), camera.tfFrame(), camera.fullResolution()) == (0.0, 0.0, "camera", (640, 480))
    assert np.array_equal(camera.intrinsicMatrix(), RAW)
    assert np.array_equal(camera.rotationMatrix(), TURN)
    assert camera.distortionCoeffs().shape == (5, 1)
    assert camera.projectionMatrix().shape == camera.fullProjectionMatrix().shape == (3, 4)
    assert camera.project_3d_to_pixel(POINT) == camera.project3dToPixel(POINT)
    without_lens = PinholeCameraModel()
    without_lens.from_camera_info(CameraInfo(width=4, height=4))
    assert without_lens.distortionCoeffs() is None


def test_binning_and_region_of_interest():
    info = camera_info(binning_x=2, binning_y=2)
    info.roi.x_offset, info.roi.y_offset, info.roi.width, info.roi.height = 40, 60, 400, 300
    part, full = PinholeCameraModel(), PinholeCameraModel()
    part.fromCameraInfo(info)
    full.fromCameraInfo(camera_info())
    u, v = full.project3dToPixel(POINT)
    assert part.project3dToPixel(POINT) == pytest.approx(((u - 40) / 2, (v - 60) / 2))
    assert np.array_equal(part.fullIntrinsicMatrix(), RAW)


def test_stereo_points_are_those_of_opencv():
    stereo = StereoCameraModel()
    stereo.fromCameraInfo(camera_info(), camera_info(baseline=0.12))
    left, right = stereo.project3dToPixel(POINT)
    assert left[1] == right[1]
    disparity = left[0] - right[0]
    assert disparity == pytest.approx(480.0 * 0.12 / POINT[2])
    assert stereo.projectPixelTo3d(left, disparity) == pytest.approx(POINT)
    image = np.full((1, 1), disparity, np.float32)
    shifted = stereo.Q @ np.array([[1, 0, 0, left[0]], [0, 1, 0, left[1]], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    assert cv2.reprojectImageTo3D(image, np.asarray(shifted))[0, 0] == pytest.approx(POINT, rel=1e-5)
    assert stereo.getZ(disparity) == pytest.approx(POINT[2])
    assert stereo.getDisparity(POINT[2]) == pytest.approx(disparity)
    assert (stereo.getZ(0), stereo.projectPixelTo3d(left, 0)) == (math.inf, (0.0, 0.0, 0.0))
    assert stereo.tfFrame() == "camera"


def test_only_images_need_opencv(camera, monkeypatch):
    monkeypatch.setitem(sys.modules, "cv2", None)
    assert camera.projectPixelTo3dRay((310, 250)) == (0.0, 0.0, 1.0)
    assert np.isfinite(camera.rectifyPoint((1, 2))).all()
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'coframe\[opencv\]'"):
        camera.rectifyImage(np.zeros((480, 640), np.uint8), np.zeros((480, 640), np.uint8))


@pytest.mark.parametrize("model", ["equidistant", "fisheye", "kannala_brandt4"])
def test_fisheye_cameras_are_rectified_as_by_opencv(model):
    k, d = np.array([[400.0, 0.0, 640.0], [0.0, 400.0, 400.0], [0.0, 0.0, 1.0]]), np.array([0.05, -0.01, 0.003, 0.0])
    info = CameraInfo(width=1280, height=800, distortion_model=model, d=d, k=k.ravel(), r=np.eye(3).ravel())
    info.p = np.column_stack([k, np.zeros(3)]).ravel()
    camera = PinholeCameraModel()
    camera.fromCameraInfo(info)
    for pixel in ((1100.0, 600.0), (640.0, 400.0), (200.0, 700.0)):
        expected = cv2.fisheye.undistortPoints(np.array([[pixel]]), k, d, P=k)[0, 0]
        assert camera.rectifyPoint(pixel) == pytest.approx(expected, abs=1e-3)
    raw = cv2.GaussianBlur(np.random.default_rng(1).integers(0, 255, (800, 1280), np.uint8), (0, 0), 4)
    rectified = np.zeros_like(raw)
    camera.rectifyImage(raw, rectified)
    maps = cv2.fisheye.initUndistortRectifyMap(k, d, np.eye(3), k, (1280, 800), cv2.CV_32FC1)
    assert np.abs(rectified.astype(int) - cv2.remap(raw, *maps, cv2.INTER_CUBIC)).max() <= 2


def test_distortion_models_that_are_not_supported_are_named(camera):
    info = camera_info(distortion_model="ftheta")
    camera.fromCameraInfo(info)
    assert camera.project3dToPixel(POINT)[0] == pytest.approx(406.0)  # P needs no lens
    with pytest.raises(CameraError, match="model 'ftheta' with 5 coefficients is not supported"):
        camera.rectifyPoint((1, 2))
