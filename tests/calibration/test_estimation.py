# SPDX-License-Identifier: Apache-2.0
"""coframe calibrate, on simulated rigs with a known mount, time offset, noise and drift."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.spatial.transform import Rotation

import coframe
from coframe import quaternion
from coframe.bags import Writer
from coframe.calibration import CalibrationError, calibrate_hand_eye, calibrate_rigid, read
from coframe.cli.app import app
from coframe.messages import find, serialize
from coframe.time import SECOND

MOUNT = coframe.Transform([0.2, -0.1, 0.35], Rotation.from_euler("xyz", [0.3, -1.2, 2.0]).as_quat())
MAP = coframe.Transform([3.0, 2.0, 1.0], Rotation.from_euler("xyz", [0.5, 0.2, 1.0]).as_quat())
OFFSET = 0.037  # seconds to add to the stamps of the sensor
START = 1_700_000_000 * SECOND


def trajectories(seed=0, *, planar=False, drift=0.0, noise=(0.003, 0.002), seconds=60.0):
    """Return the poses of a body and of a sensor on it, whose clock is behind."""
    random = np.random.default_rng(seed)
    size, rate, phase = random.uniform([0.3, 0.1, 0.0], [1.0, 0.6, 6.0], (6, 4, 3)).transpose(2, 0, 1)[:, :, :, None]

    def at(times):
        waves = (size * np.sin(2 * np.pi * rate * times + phase)).sum(axis=1).T
        turn, place = 0.35 * waves[:, :3], 0.5 * waves[:, 3:]
        if planar:
            turn[:, :2], place[:, 2] = 0.0, 0.0
        return coframe.Transform(place, Rotation.from_euler("xyz", turn).as_quat())

    def noisy(poses, times, walk=0.0):
        moved = poses.translation + random.normal(0.0, noise[0], (len(times), 3))
        moved += np.cumsum(random.normal(0.0, walk or 1e-300, (len(times), 3)), axis=0)
        turned = quaternion.multiply(
            poses.quaternion, quaternion.from_rotvec(random.normal(0.0, noise[1], (len(times), 3)))
        )
        return coframe.Transform(moved, turned, stamp=START + np.rint(times * SECOND).astype(np.int64))

    own, other = np.arange(0.0, seconds, 0.02), np.arange(0.0, seconds, 0.0333)
    sensor = noisy(MAP @ at(other) @ MOUNT, other)
    shifted = sensor.replace(stamp=sensor.stamps - round(OFFSET * SECOND))
    return noisy(at(own), own, drift), shifted


def errors(found):
    turn = quaternion.multiply(found.transform.quaternion, quaternion.inverse(MOUNT.quaternion))
    return np.concatenate([found.transform.translation - MOUNT.translation, quaternion.to_rotvec(turn)])


def normalized(seeds, **fields):
    """Return the errors of several seeds as multiples of their standard deviations; the last one is of the offset."""
    rows = []
    for seed in seeds:
        found = calibrate_rigid(*trajectories(seed, **fields), prior=MOUNT)
        rows.append([*(errors(found) / found.deviations), (found.time_offset - OFFSET) / found.time_deviation])
    return np.array(rows)


def test_mount_and_offset_are_within_their_deviations():
    found = calibrate_rigid(*trajectories())
    assert np.abs(errors(found) / found.deviations).max() < 4.0
    assert np.abs(errors(found)).max() < 2e-3
    assert abs(found.time_offset - OFFSET) < 4.0 * found.time_deviation < 1e-3
    assert found.hidden.shape == (0, 3)
    assert found.is_rotation_observable
    assert found.reference.is_close(MAP.inverse(), translation=5e-3, rotation=2e-3)


def test_planar_motion_does_not_show_the_height():
    body, sensor = trajectories(4, planar=True)
    found = calibrate_rigid(body, sensor, prior=coframe.Transform([0.0, 0.0, 0.5]))
    assert np.abs(found.hidden[0]) == pytest.approx([0.0, 0.0, 1.0], abs=0.02)
    assert found.transform.translation == pytest.approx([0.2, -0.1, 0.5], abs=5e-3), "the height is that of the prior"
    assert found.deviations[2] > 0.9
    assert np.abs((errors(found) / found.deviations)[[0, 1, 3, 4, 5]]).max() < 4.0


def test_odometry_may_drift():
    found = calibrate_rigid(*trajectories(1, drift=0.001))
    assert np.abs(errors(found)[:3]).max() < 5e-3, "absolute poses are off by 4 cm"
    assert np.abs(errors(found) / found.deviations).max() < 4.0


def test_hand_eye_on_the_gripper_and_next_to_the_robot():
    gripper, sensor = trajectories(2)
    tag = sensor.inverse()  # the tag does not move: it is the root of the sensor's poses
    found = calibrate_hand_eye(gripper, tag)
    assert np.abs(errors(found) / found.deviations).max() < 4.0
    fixed = calibrate_hand_eye(gripper, sensor, on_base=True)
    assert fixed.reference.is_close(MAP.inverse(), translation=5e-3, rotation=2e-3)


def test_what_cannot_be_estimated_is_an_error():
    body, sensor = trajectories()
    with pytest.raises(CalibrationError, match="needs at least 20 poses with stamps"):
        calibrate_rigid(body[:5], sensor)
    later = sensor.replace(stamp=sensor.stamps + 3600 * SECOND)
    with pytest.raises(CalibrationError, match="only 0 common motions"):
        calibrate_rigid(body, later, time_offset=0.0)
    still = coframe.Transform(np.zeros((200, 3)), [0.0, 0.0, 0.0, 1.0], stamp=START + np.arange(200) * SECOND // 10)
    found = calibrate_rigid(still, still, time_offset=0.0)
    assert len(found.hidden) == 3


@pytest.mark.slow
@pytest.mark.timeout(1200)
@pytest.mark.parametrize("fields", [{}, {"drift": 0.001}, {"planar": True}, {"noise": (0.01, 0.01)}])
def test_deviations_are_those_of_many_seeds(fields):
    values = normalized(range(40), **fields)
    if fields.get("planar"):
        values = values[:, [0, 1, 3, 4, 5, 6]]
    sizes = np.sqrt((values**2).mean(axis=0))
    assert sizes.max() < 1.6, sizes
    assert np.abs(values).max() < 5.0
    assert np.abs(values.mean(axis=0)).max() < 1.0, "no bias"


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    body, sensor = trajectories(3, seconds=40.0)
    path = tmp_path_factory.mktemp("run") / "run.mcap"
    with Writer(path) as bag:
        tf = bag.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        tag = bag.add_topic("/tag_pose", "geometry_msgs/msg/PoseStamped")
        for parent, child, poses in (("odom", "base_link", body), ("tag36h11:0", "camera", sensor)):
            for pose, stamp in zip(poses, poses.stamps.tolist(), strict=True):
                buffer = coframe.Buffer()
                buffer.set(parent, child, pose, stamp)
                bag.write(tf, buffer.encode(static=False), received=stamp)
        for pose, stamp in zip(sensor.inverse(), sensor.stamps.tolist(), strict=True):
            message = pose.to_msg(find("geometry_msgs/msg/PoseStamped"), "camera", stamp)
            bag.write(tag, serialize(message), received=stamp)
    return path


def run(*words):
    result = CliRunner().invoke(app, list(map(str, words)))
    assert result.exit_code == 0, result.output
    return result.output


def test_the_commands(recording, tmp_path):
    outputs = [word for name in ("mount.urdf", "mount.yaml", "residuals.html") for word in ("-o", tmp_path / name)]
    text = run("calibrate", "rigid", recording, "odom:base_link", "tag36h11:0:camera", *outputs)
    assert "base_link -> camera: x, y, z " in text
    assert "time offset: +3" in text
    assert "coframe static --frame-id base_link --child-frame-id camera --x " in text
    for name in ("mount.urdf", "mount.yaml"):
        assert read(tmp_path / name).lookup("base_link", "camera").is_close(MOUNT, translation=5e-3, rotation=5e-3)
    assert (tmp_path / "residuals.html").stat().st_size > 1000
    corrected = tmp_path / "corrected.mcap"
    run("calibrate", "rigid", recording, "odom:base_link", "tag36h11:0:camera", "-o", corrected)
    with coframe.open_bag(recording) as old, coframe.open_bag(corrected) as new:
        assert new.buffer.lookup("base_link", "camera").is_close(MOUNT, translation=5e-3, rotation=5e-3)
        assert len(new.stamps("/tag_pose")) == len(old.stamps("/tag_pose")), "everything else is copied"
    refused = CliRunner().invoke(
        app, ["calibrate", "rigid", str(recording), "odom:base_link", "tag36h11:0:camera", "-o", str(corrected)]
    )
    assert (refused.exit_code, "already exists" in refused.output) == (1, True)
    data = json.loads(run("calibrate", "hand-eye", recording, "odom", "base_link", "/tag_pose", "--json"))
    assert (data["parent"], data["child"], data["hidden_directions"]) == ("base_link", "camera", [])
    assert data["transform"][:3] == pytest.approx(MOUNT.translation, abs=5e-3)
    assert data["time_offset"] == pytest.approx(OFFSET, abs=1e-3)


def test_poses_between_sparse_detections_are_not_invented(tmp_path):
    """A tag that is seen once per second has a pose at these times only, although the robot has 50 per second."""
    path = tmp_path / "run.mcap"
    with Writer(path) as bag:
        tf = bag.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for step in range(501):
            stamp, buffer = START + step * SECOND // 50, coframe.Buffer()
            buffer.set(
                "map", "camera", coframe.Transform.from_rpy([step / 50, np.sin(step / 70), 0], yaw=step / 90), stamp
            )
            if step % 50 == 0:
                buffer.set("camera", "tag36h11:0", coframe.Transform([1.0, 0.1 * (step % 100), 0.0]), stamp)
            bag.write(tf, buffer.encode(static=False), received=stamp)
    trajectory = f"{path}:map:tag36h11:0"
    text = run("compare", trajectory, trajectory)
    assert "\n11 pairs of poses" in text
    assert "omitted 490 poses of 'tag36h11:0' in 'map' between transforms that are more than 500 ms apart" in text
    assert run("compare", trajectory, trajectory, "--max-gap", "2s").startswith("501 pairs of poses")
    result = CliRunner().invoke(app, ["calibrate", "rigid", str(path), "map:camera", "map:tag36h11:0"])
    assert (result.exit_code, "needs at least 20 poses" in result.output) == (1, True)


def test_frames_with_a_colon_can_be_compared(recording):
    text = run("compare", f"{recording}:tag36h11:0:camera", f"{recording}:tag36h11:0:camera")
    assert "APE translation" in text
