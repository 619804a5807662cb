# SPDX-License-Identifier: Apache-2.0
"""coframe calib: what it prints about two calibrations, and that each written format is read back."""

import json
import re
import subprocess

import numpy as np
import pytest
from click.testing import CliRunner

import coframe
from coframe.calibration import WRITABLE_FORMATS, CalibrationError, Rig, Tolerance, compare_rigs, read, write
from coframe.cameras import CameraModel, lens_of
from coframe.cli.app import app

CAMERA = coframe.Transform.from_rpy([0.6, 0.25, 1.5], [-1.6, 0.02, -1.55], target="base_link", source="cam0")
LIDAR = coframe.Transform.from_rpy([1.2, 0.1, 1.8], [0.01, -0.02, 0.03], target="base_link", source="lidar")
K = np.array([[400.0, 0.0, 320.5], [0.0, 410.0, 240.5], [0.0, 0.0, 1.0]])
MODEL = CameraModel(640, 480, K, lens_of("equidistant", [0.05, -0.01, 0.003, -0.0005]), frame="cam0")


def rig(camera=CAMERA, model=MODEL, **fields):
    camera = camera.replace(target="base_link", source="cam0")
    return Rig((camera, LIDAR), {"cam0": model}, **fields)


def run(*words):
    return CliRunner().invoke(app, list(map(str, words)))


def only(difference):
    (mount,) = [mount for mount in difference.mounts if mount.exceeds(Tolerance())]
    return mount


def moved(translation=CAMERA.translation, quaternion=CAMERA.quaternion):
    return coframe.Transform(translation, quaternion)


OPTICAL = coframe.Transform.from_rpy([0.0, 0.0, 0.0], [-np.pi / 2, 0.0, -np.pi / 2])


@pytest.mark.parametrize(
    ("wrong", "cause"),
    [
        (CAMERA.inverse().replace(target=None, source=None), "if it is inverted"),
        (moved(CAMERA.translation * 1000.0), "if its translation is read in millimeters"),
        (moved(CAMERA.translation * 100.0), "if its translation is read in centimeters"),
        (moved(CAMERA.translation / 0.0254), "if its translation is read in inches"),
        (moved(quaternion=np.roll(CAMERA.quaternion, 1)), "if its quaternion is read as w, x, y, z"),
        (CAMERA.replace(target=None, source=None) @ OPTICAL.inverse(), "rotation is that of the camera's body"),
        (CAMERA.replace(target=None, source=None) @ coframe.Transform.from_rpy(roll=np.pi), "axes are those of OpenGL"),
        (coframe.Transform.from_rpy(CAMERA.translation, np.degrees(CAMERA.rpy)), "degrees that were used as radians"),
    ],
)
def test_the_cause_of_a_difference_is_named(wrong, cause):
    noisy = wrong @ coframe.Transform.from_rpy([1e-4, -2e-4, 1e-4], [2e-4, -1e-4, 1e-4])
    assert cause in only(compare_rigs(rig(), rig(noisy))).cause
    assert cause in only(compare_rigs(rig(noisy), rig())).cause.replace("B agrees", "A agrees")


def test_small_differences_have_no_cause():
    mount = only(compare_rigs(rig(), rig(CAMERA.replace(target=None, source=None) @ coframe.Transform([0.016, 0, 0]))))
    assert (mount.meters, mount.radians, mount.cause) == (pytest.approx(0.016), pytest.approx(0.0, abs=1e-9), "")
    assert not compare_rigs(rig(), rig()).exceeds(Tolerance(0.0, 1e-12, 1e-6, 0.0))


def test_cameras_and_offsets_are_compared():
    other = CameraModel(640, 480, K + np.array([[0.0, 0.0, 3.0], [0.0] * 3, [0.0] * 3]), MODEL.lens, frame="cam0")
    found = compare_rigs(rig(time_offsets={"cam0": 0.02}), rig(model=other, time_offsets={"cam0": -0.02}))
    assert found.cameras[0].pixels == pytest.approx(3.0)
    assert found.offsets[0].cause == "B has the other sign"
    pinhole = CameraModel(320, 240, K, frame="cam0")
    assert compare_rigs(rig(), rig(model=pinhole)).cameras[0].reason == "images of 640 x 480 and of 320 x 240 pixels"
    with pytest.raises(CalibrationError, match="no two frames and no camera in common"):
        compare_rigs(rig(), Rig())


def test_tolerances():
    assert Tolerance.parse("5mm, 0.2deg,1px,2ms") == pytest.approx((0.005, np.radians(0.2), 1.0, 0.002))
    assert Tolerance.parse("0.01rad").meters == 1e-3
    with pytest.raises(ValueError, match="'5' is not a number with one of the units"):
        Tolerance.parse("5")


OTHER_FORMATS = {"kitti", "opencv", "easy_handeye2", "colmap", "nuscenes"}  # test_written_formats.py


@pytest.mark.parametrize("format_", sorted({*WRITABLE_FORMATS} - OTHER_FORMATS))
def test_every_written_format_is_read_back(tmp_path, format_):
    suffix = {"urdf": ".urdf", "mcap": ".mcap", "nerf": ".json", "commands": ".sh"}.get(format_, ".yaml")
    file = tmp_path / f"rig{suffix}"
    given = rig()
    if format_ == "kalibr":
        second = coframe.Transform([0.1, 0.0, 0.0], target="cam0", source="cam1")
        pair = {"cam0": MODEL, "cam1": CameraModel(640, 480, K, frame="cam1")}
        given = Rig((CAMERA.replace(target="imu"), second), pair, {"cam0": 0.012})
    write(given, file, format_)
    if format_ == "commands":
        words = file.read_text().splitlines()[1].split()
        assert float(words[words.index("--x") + 1]) == 0.6
        assert subprocess.run(["sh", "-n", file], check=False).returncode == 0
        return
    back = read(file)
    for mount in given.transforms if format_ != "camera_info" else ():
        parent = "world" if format_ == "nerf" else mount.target
        assert back.lookup(parent, mount.source).is_close(mount.replace(target=parent), translation=1e-9, rotation=1e-8)
    if format_ not in {"urdf", "autoware"}:
        camera = next(iter(back.cameras.values()))
        pixels = [[100.0, 50.0], [600.0, 400.0]]
        assert camera.project(MODEL.rays(pixels)) == pytest.approx(np.array(pixels), abs=1e-6)
    assert back.time_offsets == (given.time_offsets if format_ == "kalibr" else {})


def test_the_commands(tmp_path):
    write(rig(), tmp_path / "a.urdf")
    write(rig(CAMERA.inverse()), tmp_path / "b.yaml", "autoware")
    result = run("calib", "diff", tmp_path / "a.urdf", tmp_path / "b.yaml", "--tolerance", "5mm,0.2deg")
    assert result.exit_code == 1
    assert re.search(r"differs +base_link -> cam0: .* mm, .* deg\n +B agrees with A within 0 mm", result.output)
    assert "equal   base_link -> lidar: 0 mm, 0 deg" in result.output
    assert run("calib", "diff", tmp_path / "a.urdf", tmp_path / "a.urdf").exit_code == 0
    renamed = read(tmp_path / "a.urdf")
    write(Rig(tuple(m.replace(source=f"{m.source}_link") for m in renamed.transforms)), tmp_path / "c.urdf")
    words = ("calib", "diff", tmp_path / "a.urdf", tmp_path / "c.urdf", "--json")
    result = run(*words, "--rename", "cam0_link=cam0")
    assert [mount["child"] for mount in json.loads(result.output)["mounts"]] == ["cam0"]
    assert json.loads(result.output)["only_in_b"] == ["lidar_link"]
    assert run(*words).exit_code == 1
    assert run(*words, "--rename", "cam0").exit_code == 2
    assert run(*words, "--tolerance", "5").exit_code == 2
    shown = run("calib", "show", tmp_path / "b.yaml").output
    assert "roll, pitch, yaw in radians as in URDF" in shown
    assert run("calib", "convert", tmp_path / "b.yaml", "-o", tmp_path / "d.urdf").exit_code == 0
    assert not compare_rigs(read(tmp_path / "b.yaml"), read(tmp_path / "d.urdf")).exceeds(Tolerance())
    assert "choose one" in run("calib", "convert", tmp_path / "b.yaml", "-o", tmp_path / "d.yaml").output
