# SPDX-License-Identifier: Apache-2.0
"""Camera models, compared with OpenCV, with values of COLMAP, and with the geometry of the double sphere."""

import sys

import cv2
import numpy as np
import pytest

import coframe
from coframe.cameras import LENS_NAMES, CameraError, CameraModel, lens_of
from coframe.cameras.model_names import canonical_name
from coframe.messages import find
from coframe.time import MILLISECOND, SECOND

CameraInfo = find("sensor_msgs/msg/CameraInfo")
K = np.array([[400.0, 0.0, 640.0], [0.0, 410.0, 400.0], [0.0, 0.0, 1.0]])
POINTS = np.random.default_rng(3).uniform([-1.2, -0.8, 1.0], [1.2, 0.8, 3.0], (200, 3))
POLYNOMIALS = {
    "plumb_bob, 4": [-0.28, 0.07, 0.0002, 0.0001],
    "plumb_bob, 5": [-0.2, 0.05, 0.001, -0.002, 0.01],
    "rational_polynomial, 8": [0.3, 0.02, 0.001, -0.0005, 0.001, 0.6, 0.1, 0.01],
    "thin_prism, 12": [-0.1, 0.02, 0.001, -0.002, 0.01, 0.01, 0.002, 0.001, 0.002, -0.001, 0.003, 0.0005],
    "tilted, 14": [-0.1, 0.02, 0.001, -0.002, 0.01, 0.01, 0.0, 0.0, 0.002, -0.001, 0.003, 0.0005, 0.05, -0.03],
}
FISHEYE = [0.05, -0.01, 0.003, -0.0005]


def camera_info(model="plumb_bob", d=(), **fields):
    info = CameraInfo(width=1280, height=800, distortion_model=model, **fields)
    info.d, info.k, info.r = list(d), K.ravel().tolist(), np.eye(3).ravel().tolist()
    info.p = np.column_stack([K, np.zeros(3)]).ravel().tolist()
    info.header.frame_id = "camera_optical_frame"
    return info


def camera(model="plumb_bob", d=(), **fields):
    return CameraModel.from_info(camera_info(model, d, **fields))


@pytest.mark.parametrize("name", POLYNOMIALS)
def test_polynomials_are_those_of_opencv(name):
    d = POLYNOMIALS[name]
    model = camera(name.split(",")[0], d)
    expected = cv2.projectPoints(POINTS, np.zeros(3), np.zeros(3), K, np.array(d))[0].reshape(-1, 2)
    assert np.abs(model.project(POINTS) - expected).max() < 1e-9
    rays = POINTS / np.linalg.norm(POINTS, axis=1, keepdims=True)
    assert np.abs(model.rays(expected) - rays).max() < 1e-9


@pytest.mark.parametrize("d", [FISHEYE, [0.0] * 4])
def test_fisheye_is_that_of_opencv(d):
    model = camera("equidistant", d)
    expected = cv2.fisheye.projectPoints(POINTS[None], np.zeros(3), np.zeros(3), K, np.array(d))[0].reshape(-1, 2)
    assert np.abs(model.project(POINTS) - expected).max() < 1e-9
    # Beyond the field of view of a pinhole, and behind the image plane.
    angles = np.radians([0.0, 60.0, 85.0, 89.9, 95.0])
    wide = np.stack([np.sin(angles), np.zeros(5), np.cos(angles)], axis=1)
    pixels = model.project(wide)
    assert (np.diff(pixels[:, 0]) > 0).all()
    assert np.abs(model.rays(pixels) - wide).max() < 1e-9


def test_other_lenses_are_those_of_colmap():
    # pycolmap 4.2.1: Camera(model=..., params=[400, 410, 320, 240, ...]).img_from_cam(point)
    points = [[0.3, -0.2, 1.0], [1.2, 0.7, 1.5], [-0.9, 0.1, 0.6]]
    k = [[400.0, 0.0, 320.0], [0.0, 410.0, 240.0], [0.0, 0.0, 1.0]]
    for name, d, expected in (
        ("fov", [0.9], [[443.953902, 155.298167], [600.217963, 407.546991], [-108.316436, 288.780483]]),
        ("eucm", [0.6, 1.1], [[435.222078, 161.264913], [578.801523, 394.741744], [-73.85902, 284.856166]]),
        ("equidistant", FISHEYE, [[435.845026, 160.839232], [584.64732, 398.237043], [-88.075337, 286.475247]]),
    ):
        model = CameraModel(640, 480, k, lens_of(name, d))
        assert model.project(points) == pytest.approx(np.array(expected), abs=1e-6)
        assert model.rays(expected) == pytest.approx(
            np.array(points) / np.linalg.norm(points, axis=1, keepdims=True), abs=1e-7
        )


def test_double_sphere_is_two_spheres_and_a_pinhole():
    xi, alpha = -0.17213086, 0.59311776  # the left camera of the TUM-VI data set
    for point in ([0.3, -0.2, 1.0], [1.0, 0.4, 0.1], [-1.0, 0.2, -0.2]):
        first = np.array(point) / np.linalg.norm(point)
        second = first + np.array([0.0, 0.0, xi])
        second /= np.linalg.norm(second)
        shifted = second + np.array([0.0, 0.0, alpha / (1.0 - alpha)])
        expected = shifted[:2] / shifted[2]
        model = camera("double_sphere", [xi, alpha])
        # The pinhole is shifted by alpha / (1 - alpha); the focal length of the model absorbs the scale 1 - alpha.
        places = (model.project(point) - [640.0, 400.0]) / [400.0, 410.0] * (1.0 - alpha)
        assert places == pytest.approx(expected, abs=1e-12)
        assert model.rays(model.project(point)) == pytest.approx(first, abs=1e-12)
    assert np.isnan(model.project([0.1, 0.0, -1.0])).all()


def test_omnidirectional_rays_meet_their_points():
    model = camera("omni-radtan", [1.4, -0.1, 0.02, 0.001, -0.001])
    wide = np.array([[0.3, -0.2, 1.0], [1.0, 0.5, 0.2], [-1.0, 0.2, -0.1]])
    rays = model.rays(model.project(wide))
    assert rays == pytest.approx(wide / np.linalg.norm(wide, axis=1, keepdims=True), abs=1e-9)
    assert camera("eucm", [0.5, 1.0]).project([0.2, 0.1, 1.0]) == pytest.approx(
        camera("omni", [1.0, 0.0, 0.0, 0.0, 0.0]).project([0.2, 0.1, 1.0]) * 2 - [640.0, 400.0], abs=1e-9
    )


def test_names_are_read_in_every_spelling():
    same = {
        "plumb_bob": ("plumb bob", "Plumb-Bob", "PLUMB_BOB", "radtan", "radial-tangential", "", "OPENCV"),
        "equidistant": ("Equidistant", "fisheye", "kannala_brandt4", "KannalaBrandt", "equi", "opencv_fisheye", "kb4"),
        "double_sphere": ("DoubleSphere", "ds", "double sphere"),
    }
    d = {"plumb_bob": [-0.28, 0.07, 0.0002, 0.0001, 0.0], "equidistant": FISHEYE, "double_sphere": [-0.2, 0.6]}
    for name, spellings in same.items():
        expected = camera(name, d[name]).project(POINTS)
        for spelling in spellings:
            assert np.array_equal(camera(spelling, d[name]).project(POINTS), expected)
            assert canonical_name(spelling) == (name if spelling else "")


def test_numbers_of_coefficients():
    pinhole = camera().project(POINTS)
    for model in ("plumb_bob", "", "none", "pinhole", "inverse_brown_conrady"):
        assert np.array_equal(camera(model, [0.0] * 5).project(POINTS), pinhole)
    # A fisheye with coefficients of 0 is no pinhole, nor without coefficients, nor with five for four.
    fisheye = camera("equidistant", [0.0] * 4)
    assert fisheye.project([3.0, 0.0, 2.0]) == pytest.approx([640 + 400 * np.arctan(1.5), 400.0])
    for d in ([], [0.0] * 5, [0.0]):
        assert np.array_equal(camera("fisheye", d).project(POINTS), fisheye.project(POINTS))
    assert camera("equidistant", [*FISHEYE, 0.0]).lens == lens_of("equidistant", FISHEYE)
    assert camera("plumb_bob", [-0.2, 0.05, 0.001, -0.002, 0.01, 0.0]).lens.coefficients[4:] == (0.01,)
    assert len(LENS_NAMES) == 7


@pytest.mark.parametrize(
    ("model", "d", "error"),
    [
        ("ftheta", [0.1, 0.2], r"model 'ftheta' with 2 coefficients is not supported"),
        ("equidistant", [0.1, 0.2, 0.3, 0.4, 0.5], r"'equidistant' has 4 coefficients \(k1, k2, k3, k4\), not 5"),
        ("plumb_bob", [0.1, 0.2], "has 4 or 5 or 8 or 12 or 14 coefficients"),
        ("double_sphere", [0.1, 0.2, 0.3], r"has 2 coefficients \(xi, alpha\), not 3"),
        ("none", [0.1, 0.0, 0.0, 0.0], "'none' has no coefficients, but there are 4"),
        ("plumb_bob", [float("nan"), 0.0, 0.0, 0.0], "not finite"),
    ],
)
def test_what_is_not_supported_is_named(model, d, error):
    with pytest.raises(CameraError, match=error):
        camera(model, d)


def test_uncalibrated_cameras_are_named():
    with pytest.raises(CameraError, match="contains no calibration"):
        CameraModel.from_info(CameraInfo(width=4, height=4))
    info = camera_info()
    info.k = [0.0] * 9
    model = CameraModel.from_info(info)
    assert model.project([0.0, 0.0, 1.0], rectified=True).tolist() == [640.0, 400.0]
    with pytest.raises(CameraError, match="fx and fy of K must be positive"):
        model.project([0.0, 0.0, 1.0])


def test_points_that_the_lens_cannot_see_are_nan():
    pinhole = camera()
    assert np.isnan(pinhole.project([[0.1, 0.0, 0.0], [0.1, 0.0, -1.0], [np.nan, 0.0, 1.0]])).all()
    assert np.isnan(pinhole.project([0.1, 0.0, -1.0], rectified=True)).all()
    barrel = camera("plumb_bob", [-0.3, 0.0, 0.0, 0.0])
    assert np.isfinite(barrel.project([1.0, 0.0, 1.0])).all()
    assert np.isnan(barrel.project([1.2, 0.0, 1.0])).all()
    assert np.isnan(barrel.rays([5000.0, 400.0])).all()
    assert np.isnan(camera("equidistant").rays([640 + 400 * 3.2, 400.0])).all()
    assert pinhole.contains([[0.0, 0.0], [1279.4, 799.4], [1280.0, 5.0], [np.nan, 5.0]]).tolist() == [
        True,
        True,
        False,
        False,
    ]


def test_region_of_interest_and_binning():
    part = camera_info("plumb_bob", POLYNOMIALS["plumb_bob, 5"], binning_x=2, binning_y=4)
    part.roi.x_offset, part.roi.y_offset, part.roi.width, part.roi.height = 40, 60, 400, 300
    part, full = CameraModel.from_info(part), camera("plumb_bob", POLYNOMIALS["plumb_bob, 5"])
    assert (part.image_size, full.image_size) == ((200, 75), (1280, 800))
    for rectified in (False, True):
        pixels = part.project(POINTS, rectified=rectified)
        assert pixels == pytest.approx((full.project(POINTS, rectified=rectified) - [40, 60]) / [2, 4])
        rays = part.rays(pixels, rectified=rectified)
        assert rays == pytest.approx(POINTS / np.linalg.norm(POINTS, axis=1, keepdims=True), abs=1e-9)


def test_rectified_images_have_the_rotation_and_the_fourth_column_of_p():
    info = camera_info("plumb_bob", POLYNOMIALS["plumb_bob, 5"])
    info.p[3] = -48.0
    right = CameraModel.from_info(info)
    assert right.project([0.2, 0.0, 1.0], rectified=True).tolist() == [672.0, 400.0]
    assert right.without_baseline().project([0.2, 0.0, 1.0], rectified=True).tolist() == [720.0, 400.0]
    assert right.baseline == (0.12, 0.0)
    turn = cv2.Rodrigues(np.array([0.01, -0.02, 0.03]))[0]
    info.r = turn.ravel().tolist()
    turned = CameraModel.from_info(info)
    raw = turned.project(POINTS)
    expected = cv2.undistortPointsIter(
        raw.reshape(-1, 1, 2), K, np.array(info.d), turn, K, (cv2.TERM_CRITERIA_MAX_ITER, 200, 0)
    ).reshape(-1, 2)
    assert turned.rectify(raw) == pytest.approx(expected, abs=1e-6)
    assert turned.without_baseline().project(POINTS, rectified=True) == pytest.approx(expected, abs=1e-6)


def test_images_are_rectified_as_by_opencv(monkeypatch):
    image = cv2.GaussianBlur(np.random.default_rng(1).integers(0, 255, (240, 320, 3), np.uint8), (0, 0), 4)
    small = np.diag([0.25, 0.3, 1.0]) @ K
    fisheye = CameraModel(320, 240, small, lens_of("equidistant", FISHEYE))
    maps = cv2.fisheye.initUndistortRectifyMap(small, np.array(FISHEYE), np.eye(3), small, (320, 240), cv2.CV_32FC1)
    expected = cv2.remap(image, *maps, cv2.INTER_CUBIC)
    assert np.abs(fisheye.undistort(image).astype(int) - expected).max() <= 2
    with pytest.raises(ValueError, match=r"an image of 160 x 120 pixels; the camera sends \(320, 240\)"):
        fisheye.undistort(image[:120, :160])
    monkeypatch.setitem(sys.modules, "cv2", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'coframe\[opencv\]'"):
        fisheye.undistort(image)
    assert np.isfinite(fisheye.project(POINTS)).all()  # only images need OpenCV


def test_rolling_shutter_gives_each_row_its_own_pose():
    buffer = coframe.Buffer(cache="60s")
    for step in range(21):  # turning at 1 rad/s about y, moving at 2 m/s
        at = step * 50 * MILLISECOND
        buffer.set("map", "camera", coframe.Transform.from_rpy([2.0 * at / SECOND, 0, 0], [0, at / SECOND, 0]), at)
    points = np.array([[0.2, -0.5, 2.0], [0.1, 0.6, 2.5], [0.3, 0.0, 3.0]])
    readout, start = 30 * MILLISECOND, 400 * MILLISECOND
    model = camera("plumb_bob", POLYNOMIALS["plumb_bob, 5"])

    def pose_at(times):
        return buffer.lookup_many("camera", "map", times)

    for direction in (readout, -readout):
        pixels = model.project_rolling(points, pose_at, stamp=start, readout=direction)
        share = pixels[:, 1] / 799 if direction > 0 else 1.0 - pixels[:, 1] / 799
        times = start + np.rint(share * readout).astype(np.int64)
        each = [model.project(pose_at(times[k : k + 1]).transform_point(points[k : k + 1]))[0] for k in range(3)]
        assert pixels == pytest.approx(np.array(each), abs=0.1)
        assert np.abs(pixels - model.project(pose_at(np.full(3, start)).transform_point(points))).max() > 3.0
    behind = model.project_rolling([[0.0, 0.0, -5.0]], pose_at, stamp=start, readout=readout)
    assert np.isnan(behind).all()
