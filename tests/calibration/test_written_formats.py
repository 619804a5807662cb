# SPDX-License-Identifier: Apache-2.0
"""Files for other programs are read back: by coframe, and by the program if it is installed."""

import cv2
import numpy as np
import pytest
from click.testing import CliRunner

import coframe
from coframe.calibration import CalibrationError, Rig, read, write
from coframe.calibration.left_out import left_out
from coframe.cameras import CameraModel, lens_of
from coframe.cli.app import app

K = np.array([[400.0, 0.0, 320.5], [0.0, 410.0, 240.5], [0.0, 0.0, 1.0]])
CAMERA = coframe.Transform.from_rpy([0.6, 0.25, 1.5], [-1.6, 0.02, -1.55], target="base_link", source="left")
BESIDE = coframe.Transform([0.12, 0.001, -0.002], target="left", source="right")
VELO = coframe.Transform.from_rpy([1.2, 0.1, 1.8], [0.01, -0.02, 0.03], target="base_link", source="velo")
LENSES = [
    ("plumb_bob", [0.0] * 5),
    ("plumb_bob", [-0.2, 0.05, 0.001, -0.002, 0.0]),
    ("plumb_bob", [-0.2, 0.05, 0.001, -0.002, 0.01]),
    ("rational_polynomial", [-0.2, 0.05, 0.001, -0.002, 0.01, 0.1, 0.02, 0.003]),
    ("equidistant", [0.05, -0.01, 0.003, -0.0005]),
    ("fov", [0.9]),
    ("eucm", [0.6, 1.1]),
]
POINTS = np.array([[0.3, 0.2, 2.0], [-0.5, 0.1, 1.5], [0.0, -0.3, 3.0]])


def camera(frame, lens=("plumb_bob", (0.0,) * 5)):
    return CameraModel(640, 480, K, lens_of(*lens), frame=frame)


def pair(lens=LENSES[0]):
    return Rig((CAMERA, BESIDE, VELO), {name: camera(name, lens) for name in ("left", "right")})


def written(tmp_path, rig, name, format_=None):
    write(rig, tmp_path / name, format_)
    return read(tmp_path / name)


def agrees(found, given, target, source, named=None):
    expected = given.lookup(target, source).matrix
    return np.allclose(found.lookup(*(named or (target, source))).matrix, expected, atol=1e-12)


def test_kitti(tmp_path):
    found = written(tmp_path, pair(), "calib.txt", "kitti")
    assert agrees(found, pair(), "left", "right", ("cam0", "cam1"))
    assert agrees(found, pair(), "left", "velo", ("cam0", "velo"))
    assert np.array_equal(found.cameras["cam1"].k, K)
    turned = BESIDE @ coframe.Transform.from_rpy(yaw=0.01, source="right")
    with pytest.raises(CalibrationError, match="right is turned"):
        write(Rig((CAMERA, turned), pair().cameras), tmp_path / "a.txt", "kitti")
    with pytest.raises(CalibrationError, match="rectified cameras only, and left has a distortion"):
        write(pair(LENSES[1]), tmp_path / "a.txt", "kitti")


def test_nuscenes(tmp_path):
    found = written(tmp_path, pair(), "nuscenes", "nuscenes")
    assert all(agrees(found, pair(), "base_link", name, ("ego", name)) for name in ("left", "right", "velo"))
    assert list(found.cameras) == ["left", "right"]
    with pytest.raises(CalibrationError, match="nuScenes has no distortion"):
        write(pair(LENSES[1]), tmp_path / "other", "nuscenes")


@pytest.mark.parametrize("lens", LENSES)
def test_colmap(tmp_path, lens):
    given = pair(lens)
    found = written(tmp_path, given, "sparse", "colmap")
    assert all(agrees(found, given, "base_link", name, ("world", name)) for name in ("left", "right"))
    np.testing.assert_allclose(found.cameras["camera2"].project(POINTS), given.cameras["right"].project(POINTS))
    with pytest.raises(CalibrationError, match="no model for the lens of left: double_sphere"):
        write(pair(("double_sphere", [-0.2, 0.6])), tmp_path / "other", "colmap")


def test_colmap_reads_it(tmp_path):
    pycolmap = pytest.importorskip("pycolmap", reason="pycolmap (pip install --group oracle) is not installed")
    for number, lens in enumerate(LENSES):
        given = pair(lens)
        write(given, tmp_path / str(number), "colmap")
        scene = pycolmap.Reconstruction(str(tmp_path / str(number)))
        for image in scene.images.values():
            mine = given.cameras[image.name]
            inside = image.cam_from_world() * (given.lookup("base_link", image.name) @ POINTS)
            np.testing.assert_allclose(inside, POINTS, atol=1e-12)
            pixels = [image.camera.img_from_cam(point) for point in inside]
            np.testing.assert_allclose(np.array(pixels) - 0.5, mine.project(POINTS), atol=1e-9)


def test_opencv_reads_a_camera_and_a_pair(tmp_path):
    given = pair(LENSES[2])
    found = written(tmp_path, given, "stereo.yml", "opencv")
    assert agrees(found, given, "right", "left")
    storage = cv2.FileStorage(str(tmp_path / "stereo.yml"), cv2.FILE_STORAGE_READ)
    motion = storage.getNode("R").mat(), storage.getNode("T").mat()
    assert pytest.approx(given.lookup("right", "left") @ POINTS) == POINTS @ motion[0].T + motion[1].T
    assert storage.getNode("D2").mat().ravel().tolist() == LENSES[2][1]
    storage.release()
    fisheye = Rig((CAMERA,), {"left": camera("left", LENSES[4])})
    found = written(tmp_path, fisheye, "fisheye.yaml", "opencv")
    np.testing.assert_allclose(found.cameras["camera"].project(POINTS), fisheye.cameras["left"].project(POINTS))
    with pytest.raises(CalibrationError, match="one camera or two, and the calibration has 0"):
        write(Rig((CAMERA,)), tmp_path / "a.yaml", "opencv")


@pytest.mark.parametrize(("parent", "kind"), [("tool0", "eye_in_hand"), ("base_link", "eye_on_base")])
def test_easy_handeye2(tmp_path, parent, kind):
    given = Rig((CAMERA.replace(target=parent),))
    found = written(tmp_path, given, "arm.calib")
    assert agrees(found, given, parent, "left")
    assert f"calibration_type: {kind}" in (tmp_path / "arm.calib").read_text()
    with pytest.raises(CalibrationError, match="one mount, and the calibration has 3"):
        write(pair(), tmp_path / "b.calib")


def run(*words):
    return CliRunner().invoke(app, list(map(str, words)))


def test_what_a_format_cannot_store_is_said(tmp_path):
    rig = Rig((CAMERA, BESIDE, VELO), pair().cameras, {"left": 0.01})
    write(rig, tmp_path / "rig.mcap")
    urdf = run("calib", "convert", tmp_path / "rig.mcap", "-o", tmp_path / "rig.urdf")
    assert f"coframe: not in {tmp_path / 'rig.urdf'}, because the format cannot store it: 2 of 2 cameras" in urdf.stderr
    kitti = run("calib", "convert", tmp_path / "rig.mcap", "-o", tmp_path / "rig.txt")
    assert "cannot store it: 1 of 4 frames" in kitti.stderr
    assert not run("calib", "convert", tmp_path / "rig.mcap", "-o", tmp_path / "rig", "--to", "nuscenes").stderr
    assert left_out(rig, tmp_path / "rig.mcap") == ["1 of 1 time offset"]
    (tmp_path / "rig.urdf").write_text("<robot")
    with pytest.raises(CalibrationError, match=r"was written, but cannot be read: "):
        left_out(rig, tmp_path / "rig.urdf")


def test_names_that_colmap_would_read_as_other_names(tmp_path):
    for name in ("front left", "front\n1 2 3"):
        mount = coframe.Transform(target="base", source=name)
        with pytest.raises(CalibrationError, match="COLMAP permits no spaces in the names of images"):
            write(Rig((mount,), {name: camera(name)}), tmp_path / "reconstruction", "colmap")
    assert not (tmp_path / "reconstruction").exists()


def test_poses_of_transforms_json_are_those_in_the_root(tmp_path):
    """Also for a camera that is mounted on another one."""
    found = written(tmp_path, pair(), "transforms.json", "nerf")
    assert agrees(found, pair(), "base_link", "right", ("world", "right"))
