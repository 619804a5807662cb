# SPDX-License-Identifier: Apache-2.0
"""Each command of "Calibrations" in the documentation is run, with the files that it names."""

import itertools
import re
import shlex
import shutil
from glob import glob
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from test_estimation import MOUNT, START, trajectories  # of this folder
from test_mount_history import MOUNT as STEREO
from test_mount_history import TURN, record

import coframe
from coframe.bags import Writer
from coframe.calibration import read
from coframe.cli.app import app
from coframe.messages import find, serialize

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "calibration.md"
CAMCHAIN = """cam0:
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0002, 0.0001]
  distortion_model: radtan
  intrinsics: [700.0, 701.0, 640.5, 360.5]
  resolution: [1280, 720]
  rostopic: /camera/image_raw
  timeshift_cam_imu: 0.004
  T_cam_imu:
  - [0.0, -1.0, 0.0, 0.03]
  - [0.0, 0.0, -1.0, 0.1]
  - [1.0, 0.0, 0.0, -0.2]
  - [0.0, 0.0, 0.0, 1.0]
"""


def commands(heading):
    """Return the commands of the console blocks below a heading."""
    page, flags = PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL
    (section,) = re.findall(rf"^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", page, flags)
    blocks = re.findall(r"^```console\n(.*?)^```", section, flags)
    return [words for line in "".join(blocks).splitlines() if (words := shlex.split(line, comments=True))]


def run(words, code=0):
    """Run a command in the current folder, as a shell would, and return its output."""
    expanded = (sorted(glob(word)) or [word] for word in words)  # noqa: PTH207 - Path.glob refuses absolute paths
    program, *arguments = itertools.chain.from_iterable(expanded)
    assert program == "coframe"
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == code, result.output
    return result.output


@pytest.fixture(autouse=True)
def _folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def write_run(edges, messages):
    """Write run.mcap with transforms (parent, child, poses) and messages (topic, messages)."""
    shutil.rmtree("run.mcap", ignore_errors=True)
    with Writer("run.mcap") as bag:
        static, tf = (bag.add_topic(topic, "tf2_msgs/msg/TFMessage") for topic in ("/tf_static", "/tf"))
        for parent, child, poses in edges:
            for pose, stamp in (
                [(poses, START)] if poses.shape == () else zip(poses, poses.stamps.tolist(), strict=True)
            ):
                buffer, is_static = coframe.Buffer(), poses.shape == ()
                buffer.set(parent, child, pose, None if is_static else stamp, static=is_static)
                bag.write(static if is_static else tf, buffer.encode(static=is_static), received=stamp)
        for topic, own in messages:
            number = bag.add_topic(topic, own[0].ROS_TYPE)
            for message in own:
                stamp = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
                bag.write(number, serialize(message), received=stamp)


def test_read_and_check_a_calibration():
    show, convert, diff, doctor = commands("Read and check a calibration")
    Path("camchain-imucam.yaml").write_text(CAMCHAIN)
    rig = read("camchain-imucam.yaml")
    info = find("sensor_msgs/msg/CameraInfo")(width=1280, height=720, distortion_model="plumb_bob")
    info.d, info.k = [-0.28, 0.07, 0.0002, 0.0001, 0.0], [700.0, 0.0, 640.5, 0.0, 701.0, 360.5, 0.0, 0.0, 1.0]
    info.r, info.p = np.eye(3).ravel().tolist(), [*info.k[:3], 0.0, *info.k[3:6], 0.0, *info.k[6:], 0.0]
    info.header.frame_id = "camera_optical_frame"
    info.header.stamp.sec = START // 10**9
    imu = next(frame for frame in rig.frames if frame != "cam0")
    mount = rig.lookup(imu, "cam0").replace(target=None, source=None)
    write_run([(imu, "camera_optical_frame", mount)], [("/camera/camera_info", [info])])
    assert "T_cam_imu transforms points from the IMU" in run(show)
    assert "rig.urdf" in run(convert)
    assert read("rig.urdf").lookup(imu, "cam0").is_close(mount, translation=1e-6, rotation=1e-6)
    run(diff)
    run(doctor)
    moved = mount @ coframe.Transform([0.016, 0.0, 0.0])
    write_run([(imu, "camera_optical_frame", moved)], [("/camera/camera_info", [info])])
    assert "16" in run(diff, code=1)


def test_where_is_my_camera():
    rigid, hand_eye = commands("Where is my camera?")
    body, sensor = trajectories(3, seconds=40.0)
    write_run([("odom", "base_link", body), ("map", "camera_optical_frame", sensor)], [])
    assert "base_link -> camera_optical_frame: x, y, z " in run(rigid)
    assert (
        read("mount.urdf").lookup("base_link", "camera_optical_frame").is_close(MOUNT, translation=5e-3, rotation=5e-3)
    )
    assert Path("residuals.html").stat().st_size > 1000
    pose, stamps = find("geometry_msgs/msg/PoseStamped"), sensor.stamps.tolist()
    tags = [each.to_msg(pose, "camera", stamp) for each, stamp in zip(sensor.inverse(), stamps, strict=True)]
    write_run([("base_link", "tool0", body)], [("/tag_pose", tags)])
    assert "tool0 -> camera: x, y, z " in run(hand_eye)
    assert read("mount.yaml").lookup("tool0", "camera").is_close(MOUNT, translation=5e-3, rotation=5e-3)


def test_has_it_moved():
    install, history, doctor = commands("Has it moved?")
    assert install[:2] == ["pip", "install"]
    Path("runs").mkdir()
    days = {"tuesday": STEREO, "wednesday": STEREO @ TURN, "thursday": STEREO @ TURN}
    for day, (name, mount) in enumerate(days.items()):
        for folder in (Path(), Path("runs")):
            record(folder / f"{name}.mcap", day, mount)
    history = [word.replace("/tag_pose", "/tag") for word in history]
    printed = run(doctor, code=1), run(history, code=1)
    for text in printed:
        assert re.search(
            r"'right_optical' has moved by 0\.\d+ \+- 0\.0\d+ degrees relative to 'left_optical' since", text
        )
    pytest.importorskip("pyarrow.parquet")
    assert Path("mounts.parquet").exists()
