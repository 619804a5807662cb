# SPDX-License-Identifier: Apache-2.0
"""Sensors that have moved between recordings, of a robot with two cameras that see one tag."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

import coframe
from coframe import quaternion
from coframe.bags import Writer
from coframe.calibration import CalibrationError, find_movements, measure_mounts
from coframe.cli.app import app
from coframe.messages import find, serialize
from coframe.time import SECOND

TUESDAY = 1_700_560_800 * SECOND  # 2023-11-21 10:00
DAY = 86_400 * SECOND
MOUNT = coframe.Transform.from_rpy([0.3, -0.02, 0.01], [0.01, 0.4, -0.02])
TURN = coframe.Transform.from_rpy([0, 0, 0], yaw=np.radians(0.6))
POSE = "geometry_msgs/msg/PoseStamped"


def record(path, day, mount=MOUNT, published=MOUNT, *, seed=0, slips=False):
    """Write 12 s in which both cameras see a tag while the robot swings; its odometry is not recorded."""
    random = np.random.default_rng(seed + 10 * day)
    times = TUESDAY + day * DAY + np.arange(240) * SECOND // 20
    phase = np.arange(240) / 20
    place = np.stack([0.3 * np.sin(phase), 0.2 * np.cos(1.3 * phase), 2 + 0.4 * np.sin(0.7 * phase)], axis=1)
    turn = np.stack([0.2 * np.sin(0.9 * phase), 0.3 * np.cos(phase), 0.2 * np.sin(phase)], axis=1)
    left = coframe.Transform(place, quaternion.from_rpy(turn))
    slip = np.linspace(0, 0.05, 240) if slips else np.zeros(240)
    slipping = coframe.Transform(np.stack([slip, 0 * slip, 0 * slip], axis=1), np.tile([0.0, 0.0, 0.0, 1.0], (240, 1)))
    right = (mount @ slipping).inverse() @ left
    with Writer(path) as bag:
        static, tf = coframe.Buffer(), bag.add_topic("/tf_static", "tf2_msgs/msg/TFMessage")
        static.set("left_optical", "right_optical", published, static=True)
        bag.write(tf, static.encode(static=True), received=int(times[0]))
        for name, poses in (("left", left), ("right", right)):
            topic = bag.add_topic(f"/{name}/tag", POSE)
            moved = poses.translation + random.normal(0, 0.002, (240, 3))
            turned = quaternion.multiply(poses.quaternion, quaternion.from_rotvec(random.normal(0, 0.003, (240, 3))))
            for row, stamp in enumerate(times.tolist()):
                pose = coframe.Transform(moved[row], turned[row])
                bag.write(topic, serialize(pose.to_msg(find(POSE), f"{name}_optical", stamp)), received=stamp)
    return path


def run(*words, code=0):
    result = CliRunner().invoke(app, list(map(str, words)))
    assert result.exit_code == code, result.output
    return result.output


def test_a_moved_camera_is_named_after_two_recordings_in_a_row(tmp_path):
    days = [record(tmp_path / f"day{day}.mcap", day, MOUNT @ TURN if day > 1 else MOUNT) for day in range(4)]
    text = run("calib", "history", *days, "-o", tmp_path / "mounts.parquet", code=1)
    assert "'right_optical' has moved by 0.6" in text
    assert "degrees relative to 'left_optical' since Tuesday, 2023-11-21 10:00 (day0.mcap)" in text
    assert "two recordings in a row show it, and /tf_static is unchanged" in text
    assert run("calib", "history", *days[:2]).endswith("no sensor has moved\n")
    assert "only one recording shows it" in run("calib", "history", *days[:3])
    assert "only one recording shows it" in run("doctor", days[2], "--baseline", days[0])
    assert "has moved by 0.6" in run("doctor", days[3], "--baseline", days[0], "--baseline", days[2], code=1)
    data = json.loads(run("calib", "history", *days, "--json", code=1))
    (movement,) = data["movements"]
    assert movement["radians"] == pytest.approx(np.radians(0.6), abs=4 * movement["radians_deviation"])
    assert movement["radians_deviation"] < np.radians(0.05)
    assert movement["meters"] < 4 * movement["meters_deviation"]
    parquet = pytest.importorskip("pyarrow.parquet")
    table = parquet.read_table(tmp_path / "mounts.parquet").to_pylist()
    assert [row["child"] for row in table] == ["right_optical"] * 4
    assert table[0]["x"] == pytest.approx(0.3, abs=4 * table[0]["sigma_x"])


def test_what_is_no_movement(tmp_path):
    """A mount that was calibrated again, and one whose residuals do not fit because it slips during the recording."""
    new = MOUNT @ TURN
    again = [record(tmp_path / f"new{day}.mcap", day, *((new, new) if day else (MOUNT, MOUNT))) for day in range(3)]
    assert "no sensor has moved" in run("calib", "history", *again)
    first = record(tmp_path / "first.mcap", 0)
    slipping = [record(tmp_path / f"slip{day}.mcap", day, slips=True) for day in (1, 2)]
    text = run("calib", "history", first, *slipping, "--pair", "/left/tag", "/right/tag")
    assert "do not fit one mount: chi squared is" in text
    assert text.count("refused: chi squared") == 2
    assert "no sensor has moved" in text


def test_still_cameras_stay_quiet_and_deviations_are_true(tmp_path):
    """Errors are as large as their standard deviations say, in the same rig on many days."""
    mounts = []
    for seed in range(8):
        with coframe.open_bag(record(tmp_path / f"{seed}.mcap", seed, seed=seed)) as recording:
            mounts += measure_mounts(recording)
    assert len(mounts) == 8
    assert find_movements(mounts) == []
    errors = []
    for mount in mounts:
        turn = quaternion.to_rotvec(
            quaternion.multiply(mount.transform.quaternion, quaternion.inverse(MOUNT.quaternion))
        )
        deviations = np.sqrt(np.diag(mount.transform.covariance))
        errors.append(np.concatenate([mount.transform.translation - MOUNT.translation, turn]) / deviations)
        assert 0.6 < mount.chi_squared < 1.6
    sizes = np.sqrt((np.array(errors) ** 2).mean())
    assert 0.6 < sizes < 1.6


def test_what_cannot_be_compared_is_an_error(tmp_path):
    bag = record(tmp_path / "run.mcap", 0)
    assert "need the recording BAG and a --baseline" in run("doctor", bag, "--pair", "/left/tag", "/right/tag", code=2)
    assert "unknown suffix" in run("calib", "history", bag, "-o", tmp_path / "a.xlsx", code=2)
    text = run("calib", "history", bag, "--pair", "/left/tag", "/left/tag", code=1)
    assert "not those of two sensors" in text
    assert "no recording shows a mount" in text


def test_a_recording_that_cannot_be_read_is_not_said_to_show_no_mount(tmp_path):
    bag, absent = record(tmp_path / "run.mcap", 0), tmp_path / "absent.mcap"
    text = run("doctor", bag, "--baseline", absent, code=1)
    assert text.startswith(f"coframe: {absent} cannot be read")
    assert "mount" not in text.replace(str(absent), "")
    assert "no recording shows" not in run("calib", "history", absent, code=1)
    assert "no sensor has moved" in run("calib", "history", bag, absent)


def measured(path, shown):
    """Return the mounts between two cameras; the second one shows the tag at the given poses, the first one at none."""
    pose = find(POSE)
    with Writer(path) as bag:
        topics = {name: bag.add_topic(f"/{name}/tag", POSE) for name in ("left", "right")}
        for row, place in enumerate(shown):
            stamp = TUESDAY + row * SECOND // 20
            for name, each in (("left", coframe.Transform()), ("right", place)):
                bag.write(topics[name], serialize(each.to_msg(pose, name, stamp)), received=stamp)
    with coframe.open_bag(path) as recording:
        return measure_mounts(recording, [("/left/tag", "/right/tag")])


def test_rounded_poses_are_measured(tmp_path):
    """Each coordinate has one value in two of three poses, so that its median deviation is zero."""
    (mount,) = measured(tmp_path / "a.mcap", [coframe.Transform(0.01 * np.eye(3)[row % 3]) for row in range(120)])
    assert np.allclose(mount.transform.translation, -0.01 / 3, atol=1e-4)


def test_poses_that_mostly_contradict_each_other_show_no_mount(tmp_path):
    steps = 0.05 * np.eye(6)[np.arange(120) % 6]
    shown = [coframe.Transform(step[:3], quaternion.from_rotvec(step[3:])) for step in steps]
    with pytest.raises(CalibrationError, match="of 120 common poses are outliers"):
        measured(tmp_path / "a.mcap", [*shown])


def test_options_that_the_baseline_does_not_use_are_refused(tmp_path):
    recording = record(tmp_path / "a.mcap", 0)
    text = run("doctor", recording, "--baseline", recording, "--namespace", "robot1", code=2)
    assert "--namespace and --baseline are mutually exclusive" in text
    missing = run("calib", "history", tmp_path / "missing.mcap", recording)
    assert missing.count("missing.mcap") == 1
