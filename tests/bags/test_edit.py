# SPDX-License-Identifier: Apache-2.0
"""Edited copies of recordings: rosbags, which shares no code, finds that only what a rule names has changed."""

import json
import math
import re
import shlex
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import drives
import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from drives import MS, SECOND, START, Drive
from mcap.reader import make_reader
from mcap.writer import CompressionType
from mcap.writer import Writer as McapWriter
from rosbags.rosbag2 import CompressionMode, StoragePlugin

import coframe
from coframe.bags import Recipe, edit
from coframe.bags.editing import RULES
from coframe.cli.app import app
from coframe.cli.bag_edit import NOTHING_MATCHED


def run(*arguments):
    return CliRunner().invoke(app, ["bag", "edit", *map(str, arguments)])


def doctor(path):
    return CliRunner().invoke(app, ["doctor", str(path), "--json"])


def codes(path):
    """Return the codes of the doctor's warnings and errors."""
    return [one["code"] for one in json.loads(doctor(path).stdout)["findings"] if one["severity"] != "note"]


def healthy(path):
    return doctor(path).exit_code == 0


@pytest.fixture(params=[StoragePlugin.MCAP, StoragePlugin.SQLITE3], ids=["mcap", "sqlite"])
def plugin(request):
    return request.param


@pytest.fixture
def drive(tmp_path, plugin):
    return drives.write(tmp_path / "drive", Drive(), plugin)


# What is broken, and the command that repairs it


def test_a_misspelled_frame(tmp_path, plugin):
    mounts = {("Laser" if child == "laser" else child): mount for child, mount in Drive().mounts.items()}
    broken = drives.write(tmp_path / "broken", Drive(mounts=mounts), plugin)
    assert codes(broken) == ["TF014"]
    result = run(broken, "-o", tmp_path / "fixed", "--rename-frame", "Laser=laser")
    assert (result.exit_code, result.stdout.splitlines()[0]) == (0, "rename-frame Laser=laser: 1 frame name changed")
    assert healthy(tmp_path / "fixed")
    assert drives.differences(broken, tmp_path / "fixed") == {"/tf_static": 1}
    assert drives.connections(broken) == drives.connections(tmp_path / "fixed")


def test_a_clock_that_is_an_hour_off(tmp_path, plugin):
    broken = drives.write(tmp_path / "broken", Drive(tf_shift=-3600 * SECOND), plugin)
    assert "TF009" in codes(broken)
    assert run(broken, "-o", tmp_path / "fixed", "--shift", "base_link=+1h").exit_code == 0
    assert healthy(tmp_path / "fixed")
    right = drives.write(tmp_path / "right", Drive(), plugin)
    assert drives.contents(tmp_path / "fixed") == drives.contents(right)


def test_missing_static_transforms(tmp_path, plugin):
    broken = drives.write(tmp_path / "broken", Drive(mounts={}), plugin)
    assert codes(broken) == ["TF014", "TF014"]
    laser = "--set-static base_link laser 0.2 0 0.3 0 0 0"
    camera = "--set-static base_link camera_optical 0.25 0 0.4 -1.5707963267948966 0 -1.5707963267948966"
    assert run(broken, *laser.split(), *camera.split(), "-o", tmp_path / "fixed").exit_code == 0
    assert healthy(tmp_path / "fixed")
    added, *_ = drives.decoded(tmp_path / "fixed", "/tf_static")
    assert added[0] == drives.contents(broken)[0][1]
    rest = [each for each in drives.contents(tmp_path / "fixed") if each[0] != "/tf_static"]
    assert rest == drives.contents(broken)
    with coframe.open_bag(tmp_path / "fixed") as bag:
        np.testing.assert_allclose(bag.buffer.lookup("base_link", "laser").values, (0.2, 0, 0.3, 0, 0, 0, 1))
        np.testing.assert_allclose(bag.buffer.lookup("base_link", "camera_optical").values[3:], (-0.5, 0.5, -0.5, 0.5))


WRONG = {
    "millimeters": ("laser", (200.0, 0.0, 300.0, 0.0, 0.0, 0.0, 1.0)),
    "degrees": ("laser", (0.2, 0.0, 0.3, 0.0, 0.0, math.sin(45), math.cos(45))),
    "optical": ("camera_optical", (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)),
}


@pytest.mark.parametrize("fault", WRONG)
def test_a_wrong_mount(tmp_path, fault, plugin):
    child, wrong = WRONG[fault]
    mounts = Drive().mounts
    parent, right = mounts[child]
    broken = drives.write(tmp_path / "broken", Drive(mounts={**mounts, child: (parent, wrong)}), plugin)
    assert "TF021" in codes(broken)
    pose = [f"{value:g}" for value in right]
    assert run(broken, "-o", tmp_path / "fixed", "--replace-mount", child, *pose).exit_code == 0
    assert healthy(tmp_path / "fixed")
    assert drives.contents(tmp_path / "fixed") == drives.contents(drives.write(tmp_path / "right", Drive(), plugin))


def test_two_robots(tmp_path, plugin):
    """Two recordings with the same names become one with two robots."""
    for robot in ("robot1", "robot2"):
        one = drives.write(tmp_path / f"{robot}_in", Drive(), plugin)
        renamed = ["--rename-topic", f"/scan=/{robot}/scan", "--rename-topic", f"/odom=/{robot}/odom"]
        renamed += ["--rename-topic", f"/image=/{robot}/image", "--rename-topic", f"/markers=/{robot}/markers"]
        dropped = ["--drop-topic", "/robot_description"]
        prefix = ["--prefix", f"{robot}/", "--keep", "map"]
        result = run(one, "-o", tmp_path / robot, *prefix, *renamed, *dropped)
        assert result.exit_code == 0
        expected = drives.write(tmp_path / f"{robot}_right", Drive(prefix=f"{robot}/"), plugin)
        assert drives.contents(tmp_path / robot) == drives.contents(expected)
        assert healthy(tmp_path / robot)
    merged = ["bag", "merge", str(tmp_path / "robot1"), str(tmp_path / "robot2"), "-o", str(tmp_path / "both")]
    assert CliRunner().invoke(app, merged).exit_code == 0
    assert healthy(tmp_path / "both")


def test_a_publisher_that_sends_everything_twice(tmp_path, plugin):
    broken = drives.write(tmp_path / "broken", Drive(repeats=True), plugin)
    assert codes(broken) == ["TF011"]
    assert run(broken, "-o", tmp_path / "fixed", "--dedupe").exit_code == 0
    assert healthy(tmp_path / "fixed")
    assert drives.contents(tmp_path / "fixed") == drives.contents(drives.write(tmp_path / "right", Drive(), plugin))


def test_one_of_two_publishers_that_disagree(tmp_path, plugin):
    broken = drives.write(tmp_path / "broken", Drive(second=(0.5, 0.4)), plugin)
    assert codes(broken) == ["TF003"]
    assert run(broken, "-o", tmp_path / "fixed", "--drop-publisher", "odom->base_link#2").exit_code == 0
    assert healthy(tmp_path / "fixed")
    assert drives.contents(tmp_path / "fixed") == drives.contents(drives.write(tmp_path / "right", Drive(), plugin))


# Rules


def test_a_frame_is_renamed_in_all_messages(tmp_path, drive):
    report = edit(drive, tmp_path / "new", ["rename-frame base_link=chassis", "rename-frame laser=l"])
    assert [one.changes > 0 for one in report.rules] == [True, True]
    changed = drives.differences(drive, tmp_path / "new")
    assert changed.keys() == {"/tf", "/tf_static", "/scan", "/odom", "/markers", "/robot_description"}
    new = tmp_path / "new"
    assert {message.header.frame_id for _, message in drives.decoded(new, "/scan")} == {"l"}
    assert {message.child_frame_id for _, message in drives.decoded(new, "/odom")} == {"chassis"}
    assert {one.header.frame_id for _, each in drives.decoded(new, "/markers") for one in each.markers} == {"chassis"}
    described = drives.decoded(new, "/robot_description")[0][1].data
    expected = drives.URDF.replace('"base_link"', '"chassis"').replace('link name="laser"', 'link name="l"')
    assert described == expected.replace('<child link="laser"', '<child link="l"')
    for (_, old), (_, now) in zip(drives.decoded(drive, "/scan"), drives.decoded(new, "/scan"), strict=True):
        np.testing.assert_array_equal(old.ranges, now.ranges)
        assert (old.angle_max, old.header.stamp) == (now.angle_max, now.header.stamp)
    assert healthy(new)


@pytest.mark.parametrize("name", ["l", "la", "laser_front_left", "a" * 300, "läser"])
def test_names_of_any_length_keep_the_numbers_behind_them(tmp_path, drive, name):
    """Frame names move the numbers behind them, which stay aligned."""
    new = tmp_path / "new"
    edit(
        drive,
        new,
        [f"rename-frame laser={name}", f"rename-frame camera_optical={name}_c", f"rename-frame odom={name}_o"],
    )
    edit(
        new,
        tmp_path / "back",
        [f"rename-frame {name}=laser", f"rename-frame {name}_c=camera_optical", f"rename-frame {name}_o=odom"],
    )
    assert drives.contents(tmp_path / "back") == drives.contents(drive)
    for topic in ("/scan", "/image", "/odom"):
        assert len(drives.decoded(new, topic)) == len(drives.decoded(drive, topic))
    poses = [str(drives.decoded(path, "/odom")[5][1].pose.pose) for path in (new, drive)]
    assert poses[0] == poses[1]


def test_stamps_of_a_topic_are_shifted_in_place(tmp_path, drive):
    edit(drive, tmp_path / "new", ["shift /scan=+35ms", "shift /markers=-1.5s"])
    assert drives.differences(drive, tmp_path / "new").keys() == {"/scan", "/markers"}

    def stamps(path, topic, of=lambda message: message.header.stamp):
        return [of(message).sec * SECOND + of(message).nanosec for _, message in drives.decoded(path, topic)]

    for topic, offset, of in (
        ("/scan", 35 * MS, lambda m: m.header.stamp),
        ("/markers", -1500 * MS, lambda m: m.markers[1].header.stamp),
    ):
        old, new = (np.array(stamps(path, topic, of)) for path in (drive, tmp_path / "new"))
        assert set((new - old).tolist()) == {offset}


def test_a_shift_of_a_frame_concerns_its_transforms_and_messages(tmp_path, drive):
    report = edit(drive, tmp_path / "new", ["shift laser=+10ms", "shift map->odom=+1ms"])
    assert drives.differences(drive, tmp_path / "new").keys() == {"/scan", "/tf", "/tf_static"}
    assert [one.changes for one in report.rules] == [len(drives.decoded(drive, "/scan")) + 1, 200]


def test_log_times_are_shifted_without_the_stamps(tmp_path, drive):
    edit(drive, tmp_path / "new", ["shift-log /scan=+20ms"])
    old, new = drives.decoded(drive, "/scan"), drives.decoded(tmp_path / "new", "/scan")
    assert [at + 20 * MS for at, _ in old] == [at for at, _ in new]
    assert [message.header.stamp for _, message in old] == [message.header.stamp for _, message in new]


def test_a_stamp_before_1970_stays(tmp_path, drive):
    report = edit(drive, tmp_path / "new", ["shift /scan=-500000h"])
    assert report.rules[0].changes == 0
    assert any("before 1970" in note for note in report.notes)


def test_topics_are_dropped_and_renamed(tmp_path, drive):
    report = edit(drive, tmp_path / "new", ["drop-topic /image", "rename-topic /scan=/front/scan"])
    expected = [
        (topic.replace("/scan", "/front/scan"), at, data)
        for topic, at, data in drives.contents(drive)
        if topic != "/image"
    ]
    assert drives.contents(tmp_path / "new") == expected
    assert [one.changes for one in report.rules] == [
        len(drives.decoded(drive, "/image")),
        len(drives.decoded(drive, "/scan")),
    ]
    new, old = drives.connections(tmp_path / "new"), drives.connections(drive)
    assert new.keys() == old.keys() - {"/image", "/scan"} | {"/front/scan"}
    assert new["/front/scan"] == old["/scan"]


def test_a_time_span_keeps_the_static_transforms(tmp_path, drive):
    edit(drive, tmp_path / "new", ["time 1s..2s"])
    begin, end = START - 60 * MS + SECOND, START - 60 * MS + 2 * SECOND
    kept = drives.contents(tmp_path / "new")
    assert {at for topic, at, _ in kept if topic == "/tf_static"} == {begin}
    assert [each for each in kept if each[0] != "/tf_static"] == [
        each for each in drives.contents(drive) if begin <= each[1] <= end and each[0] != "/tf_static"
    ]
    assert healthy(tmp_path / "new")


def test_a_topic_is_thinned(tmp_path, drive):
    edit(drive, tmp_path / "new", ["rate /scan=5", "rate /tf=10hz"])
    scans = [at for at, _ in drives.decoded(tmp_path / "new", "/scan")]
    assert set(np.diff(scans).tolist()) == {200 * MS}
    for child in ("odom", "base_link"):
        times = [
            at
            for at, message in drives.decoded(tmp_path / "new", "/tf")
            if message.transforms[0].child_frame_id == child
        ]
        assert len(times) == 40
    assert [each for each in drives.contents(drive) if each[0] == "/odom"] == [
        each for each in drives.contents(tmp_path / "new") if each[0] == "/odom"
    ]


def test_a_static_transform_replaces_the_recorded_one_where_it_is(tmp_path, drive):
    edit(drive, tmp_path / "new", ["set-static camera laser 1 2 3 0 0 0 1"])
    assert drives.differences(drive, tmp_path / "new") == {"/tf_static": 1}
    ((_, message),) = drives.decoded(tmp_path / "new", "/tf_static")
    by_child = {one.child_frame_id: one for one in message.transforms}
    assert (by_child["laser"].header.frame_id, by_child["laser"].transform.translation.z) == ("camera", 3.0)
    old = {one.child_frame_id: one for one in drives.decoded(drive, "/tf_static")[0][1].transforms}
    assert str(by_child["camera"]) == str(old["camera"])


def test_rules_find_the_names_that_earlier_rules_wrote(tmp_path, drive):
    rules = ["rename-frame laser=lidar", "set-static base_link lidar 1 0 0 0 0 0", "prefix r1/", "shift r1/lidar=+1ms"]
    report = edit(drive, tmp_path / "new", rules)
    assert not report.unmatched
    assert len(drives.contents(tmp_path / "new")) == len(drives.contents(drive))
    with coframe.open_bag(tmp_path / "new") as bag:
        assert bag.buffer.lookup("r1/base_link", "r1/lidar").values[0] == 1.0


CLOCK_OFFSET = 1_719_999_000 * SECOND  # between the system clock and simulated time


def simulated(path, plugin, *, wall):
    """Write a recording with /clock at half speed, whose topics in `wall` have stamps of the system clock."""
    rows = []
    for number, at in enumerate(range(START, START + 2 * SECOND, 10 * MS)):
        now = 1000 * SECOND + number * 5 * MS
        rows.append(("/clock", at, drives.T["Clock"](drives.header(now, "").stamp)))
        for topic, message in (
            ("/tf", lambda stamp: drives.tf(drives.transform(stamp, "odom", "base_link", (0, 0, 0, 0, 0, 0, 1)))),
            ("/scan", lambda stamp: drives.scan(stamp, "base_link")),
        ):
            rows.append((topic, at + 2 * MS, message(at if topic in wall else now)))
    with drives.Rosbag2Writer(path, version=9, storage_plugin=plugin) as writer:
        connections = {}
        for topic, at, message in rows:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, message.__msgtype__, typestore=drives.store)
            writer.write(connections[topic], at, drives.store.serialize_cdr(message, message.__msgtype__))
    return path


@pytest.mark.parametrize("clock", ["sim", "wall"])
def test_stamps_are_converted_to_one_clock(tmp_path, plugin, clock):
    mixed = simulated(tmp_path / "mixed", plugin, wall={"/scan"})
    assert "TF009" in codes(mixed)
    edit(mixed, tmp_path / "new", [f"clock {clock}"])
    right = simulated(tmp_path / "right", plugin, wall={"/scan", "/tf"} if clock == "wall" else set())
    for topic in ("/tf", "/scan"):
        of = (lambda m: m.transforms[0].header.stamp) if topic == "/tf" else (lambda m: m.header.stamp)
        new, expected = (
            np.array([of(m).sec * SECOND + of(m).nanosec for _, m in drives.decoded(path, topic)])
            for path in (tmp_path / "new", right)
        )
        assert np.abs(new - expected)[5:].max() < 3 * MS
    assert "TF009" not in codes(tmp_path / "new")


def test_a_clock_needs_a_recorded_one(tmp_path, drive):
    result = run(drive, "-o", tmp_path / "new", "--clock", "sim")
    assert result.exit_code == 1
    assert "the recording has no /clock" in result.stderr
    assert "--shift" in result.stderr


# Where static transforms come from

KALIBR = """\
cam0:
  camera_model: pinhole
  intrinsics: [461.6, 460.3, 363.0, 248.1]
  T_cam_imu:
  - [0.0, -1.0, 0.0, 0.1]
  - [0.0, 0.0, -1.0, 0.2]
  - [1.0, 0.0, 0.0, -0.3]
  - [0.0, 0.0, 0.0, 1.0]
  rostopic: /image
cam1:
  camera_model: pinhole
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.11]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  rostopic: /right/image
"""
AUTOWARE = """\
base_link:
  kit:
    {x: 0.5, y: 0.0, z: 1.5, roll: 0.0, pitch: 0.0, yaw: 1.5707963267948966}
kit:
  laser: {x: 0.1, y: 0.2, z: 0.3, roll: 0.0, pitch: 0.0, yaw: 0.0}
"""
STEREO = """\
camera_name: right
image_width: 640
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
projection_matrix: {rows: 3, cols: 4, data: [400, 0, 320, -48, 0, 400, 240, 0, 0, 0, 1, 0]}
"""


def statics(path):
    with coframe.open_bag(path) as bag:
        edges = {edge.child: edge.parent for edge in bag.buffer.edges() if edge.static}
        return {child: (parent, bag.buffer.lookup(parent, child).values) for child, parent in edges.items()}


def test_mounts_of_kalibr(tmp_path, drive):
    (tmp_path / "camchain.yaml").write_text(KALIBR)
    result = run(drive, "-o", tmp_path / "new", "--set-static", tmp_path / "camchain.yaml", "imu=base_link")
    assert result.exit_code == 0, result.output
    parent, pose = statics(tmp_path / "new")["camera_optical"]
    assert parent == "base_link"
    # The camera looks along x of the IMU; the inverse of the matrix is its pose.
    np.testing.assert_allclose(pose[:3], (0.3, 0.1, 0.2), atol=1e-12)
    np.testing.assert_allclose(np.array(pose[3:]) * np.sign(pose[6]), (-0.5, 0.5, -0.5, 0.5), atol=1e-12)
    np.testing.assert_allclose(statics(tmp_path / "new")["cam1"][1], (0.11, 0, 0, 0, 0, 0, 1), atol=1e-12)


def test_mounts_of_autoware(tmp_path, drive):
    (tmp_path / "sensor_kit_calibration.yaml").write_text(AUTOWARE)
    edit(drive, tmp_path / "new", [f"set-static {tmp_path / 'sensor_kit_calibration.yaml'}"])
    found = statics(tmp_path / "new")
    assert found["laser"] == ("kit", pytest.approx((0.1, 0.2, 0.3, 0, 0, 0, 1)))
    assert found["kit"] == ("base_link", pytest.approx((0.5, 0, 1.5, 0, 0, math.sqrt(0.5), math.sqrt(0.5))))


def test_the_mount_of_a_right_camera(tmp_path, drive):
    (tmp_path / "right.yaml").write_text(STEREO)
    edit(drive, tmp_path / "new", [f"set-static {tmp_path / 'right.yaml'} left=camera_optical right=right_optical"])
    assert statics(tmp_path / "new")["right_optical"] == ("camera_optical", pytest.approx((0.12, 0, 0, 0, 0, 0, 1)))


def test_mounts_of_a_robot_description_and_of_a_recording(tmp_path, drive):
    urdf = tmp_path / "robot.urdf"
    urdf.write_text(drives.URDF.replace("0.2 0 0.3", "1 2 3"))
    edit(drive, tmp_path / "a", [f"set-static {urdf}"])
    assert statics(tmp_path / "a")["laser"] == ("base_link", pytest.approx((1, 2, 3, 0, 0, 0, 1)))
    bare = drives.write(tmp_path / "bare", Drive(mounts={}))
    edit(bare, tmp_path / "b", [f"set-static {tmp_path / 'a'}"])
    assert statics(tmp_path / "b") == statics(tmp_path / "a")


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("a: [1", "not valid YAML"),
        ("- 1", "not a calibration"),
        ("cam0: {camera_model: pinhole, T_cam_imu: [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}", "not a rotation"),
        ("cam0: {camera_model: pinhole, T_cam_imu: 3}", "matrix"),
        ("base: {child: {x: .nan}}", "finite"),
        ("x: 1", "no static transforms"),
    ],
)
def test_a_calibration_that_is_none(tmp_path, text, reason):
    drive = drives.write(tmp_path / "drive", Drive(seconds=1))
    (tmp_path / "c.yaml").write_text(text)
    with pytest.raises(coframe.EditError, match=reason):
        edit(drive, tmp_path / "new", [f"set-static {tmp_path / 'c.yaml'} imu=base_link"])
    assert not (tmp_path / "new").exists()


# Recipes and the command line


def test_a_recipe_is_saved_and_applied_again(tmp_path, drive):
    rules = [
        "--rename-frame",
        "laser=lidar",
        "--shift",
        "/scan=+35ms",
        "--set-static",
        *["base_link", "x", "0", "0", "-1", "0", "0", "0"],
    ]
    saved = run(drive, "-o", tmp_path / "a", *rules, "--save-recipe", tmp_path / "fix.yaml")
    again = run(drive, "-o", tmp_path / "b", "--recipe", tmp_path / "fix.yaml")
    assert (saved.exit_code, again.exit_code) == (0, 0)
    assert saved.stdout.splitlines()[:3] == again.stdout.splitlines()[:3]
    assert drives.contents(tmp_path / "a") == drives.contents(tmp_path / "b")
    assert "- rename-frame: laser=lidar" in (tmp_path / "fix.yaml").read_text()


def test_a_dry_run_writes_nothing_and_counts_the_same(tmp_path, drive):
    rules = ["--rename-frame", "laser=lidar", "--drop-topic", "/image", "--dedupe"]
    before = sorted(path.name for path in tmp_path.iterdir())
    dry = run(drive, "--dry-run", *rules)
    assert sorted(path.name for path in tmp_path.iterdir()) == before
    wet = run(drive, "-o", tmp_path / "new", *rules)
    assert dry.stdout.splitlines()[:3] == wet.stdout.splitlines()[:3]
    assert (dry.exit_code, wet.exit_code) == (NOTHING_MATCHED, NOTHING_MATCHED)  # nothing is recorded twice


@pytest.mark.parametrize(
    ("rule", "hint"),
    [
        (["--rename-frame", "lasr=x"], "Did you mean 'laser'?"),
        (["--rename-topic", "/scam=/x"], "Did you mean '/scan'?"),
        (["--drop-topic", "/imag"], "Did you mean '/image'?"),
        (["--shift", "/scann=1s"], "Did you mean '/scan'?"),
        (["--rate", "/odm=1"], "Did you mean '/odom'?"),
        (["--replace-mount", "lasser", *["0", "0", "0", "0", "0", "0"]], "Did you mean 'laser'?"),
        (["--drop-publisher", "odom->base_lnk"], "Did you mean 'base_link'?"),
    ],
)
def test_a_rule_that_matches_nothing(tmp_path, rule, hint):
    drive = drives.write(tmp_path / "drive", Drive(seconds=1))
    result = run(drive, "-o", tmp_path / "new", *rule)
    assert result.exit_code == NOTHING_MATCHED
    assert "matched nothing" in result.stderr
    assert hint in result.stderr
    assert drives.contents(tmp_path / "new") == drives.contents(drive)


@pytest.mark.parametrize(
    "rule",
    [
        ["--rename-frame", "laser"],
        ["--rename-frame", "laser=laser"],
        ["--shift", "/scan=soon"],
        ["--shift", "/scan=0"],
        ["--rate", "/scan=0"],
        ["--time", "1s"],
        ["--prefix", "/robot"],
        ["--clock", "moon"],
        ["--set-static", "a", "b", "1"],
        ["--set-static", *["a", "a", "0", "0", "0", "0", "0", "0"]],
        ["--set-static", *["a", "b", "0", "0", "0", "0", "0", "0", "0"]],
        ["--replace-mount", "a", "nan", "0", "0", "0", "0", "0"],
        ["--drop-publisher", "/scan@"],
        ["--rename-frame"],
        [],
    ],
    ids=" ".join,
)
def test_a_rule_that_cannot_be_understood(tmp_path, rule):
    drive = drives.write(tmp_path / "drive", Drive(seconds=1))
    result = run(drive, "-o", tmp_path / "new", *rule)
    assert result.exit_code == 2, result.output
    assert not (tmp_path / "new").exists()


def test_the_input_is_never_overwritten(drive):
    before = drives.contents(drive)
    result = run(drive, "-o", drive, "--dedupe")
    assert result.exit_code == 1
    assert "is not overwritten" in result.stderr
    assert drives.contents(drive) == before


def test_a_recording_without_a_rule_that_matches_is_byte_for_byte_the_same(tmp_path, drive):
    edit(drive, tmp_path / "new", ["rename-frame nothing=else"])
    assert drives.contents(tmp_path / "new") == drives.contents(drive)
    assert drives.connections(tmp_path / "new") == drives.connections(drive)


# Formats


def everything(path, compression=CompressionType.ZSTD, *, chunked=True):
    """Write an MCAP file with all that a file can contain, and times that are not in order."""
    with path.open("wb") as stream:
        writer = McapWriter(stream, compression=compression, use_chunking=chunked, chunk_size=3000, enable_crcs=True)
        writer.start(profile="ros2", library="other")
        writer.add_attachment(1, 2, "notes.txt", "text/plain", b"calibrated on Monday")
        writer.add_metadata("weather", {"sky": "blue", "wind": "none"})
        tf = writer.register_schema(recordings.TF, "ros2msg", b"geometry_msgs/TransformStamped[] transforms\n")
        other = writer.register_schema("acme.Thing", "jsonschema", b'{"type": "object"}')
        qos = {"offered_qos_profiles": "- history: 3\n  depth: 7\n", "note": "kept"}
        moving = writer.register_channel("/tf", "cdr", tf, metadata=qos)
        static = writer.register_channel("/tf_static", "cdr", tf, metadata={"callerid": "/mounts"})
        thing = writer.register_channel("/thing", "json", other)
        for number, (topic, at, data) in enumerate(recordings.messages()):
            late = 50 * MS if number % 7 == 0 else 0
            channel = static if topic == "/tf_static" else moving
            writer.add_message(channel, log_time=at - late, publish_time=at - 5, data=data, sequence=number + 100)
            writer.add_message(thing, log_time=at, publish_time=at, data=b'{"frame_id": "base"}', sequence=number)
        writer.finish()
    return path


def records(path):
    """Return all that a file contains, as the reference reader reads it, in the order of the file."""
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        messages = [
            (channel.topic, message.channel_id, message.sequence, message.log_time, message.publish_time, message.data)
            for _, channel, message in reader.iter_messages(log_time_order=False)
        ]
        summary = reader.get_summary()
        attachments = [(one.name, one.media_type, one.data, one.log_time) for one in reader.iter_attachments()]
        metadata = [(one.name, one.metadata) for one in reader.iter_metadata()]
        return messages, summary, attachments, metadata


@pytest.mark.parametrize("compression", CompressionType)
@pytest.mark.parametrize("chunked", [True, False])
def test_all_records_of_mcap_are_kept(tmp_path, compression, chunked):
    old = everything(tmp_path / "old.mcap", compression, chunked=chunked)
    edit(old, tmp_path / "new.mcap", ["shift lidar=+1ms"])
    (before, one, *rest), (after, other, *others) = records(old), records(tmp_path / "new.mcap")
    assert rest == others
    assert [each[:-1] for each in before] == [each[:-1] for each in after]
    assert [each[0] for each, new in zip(before, after, strict=True) if each != new] == ["/tf_static"]
    assert (one.schemas, one.channels) == (other.schemas, other.channels)
    assert one.statistics == other.statistics
    assert {each.compression for each in one.chunk_indexes} == {each.compression for each in other.chunk_indexes}
    with ReaderOf(tmp_path / "new.mcap") as reader:
        assert (reader.get_header().profile, reader.get_header().library[:5]) == ("ros2", "other")


class ReaderOf:
    def __init__(self, path):
        self._stream = path.open("rb")

    def __enter__(self):
        return make_reader(self._stream)

    def __exit__(self, *_):
        self._stream.close()


def test_chunks_that_do_not_change_are_copied(tmp_path):
    """An edit that changes nothing gives the same data section, also if this library would compress it otherwise."""
    old = everything(tmp_path / "old.mcap")
    edit(old, tmp_path / "new.mcap", ["rename-frame nothing=else"])
    data = old.read_bytes()
    end = records(old)[1].chunk_indexes[-1].chunk_start_offset
    assert (tmp_path / "new.mcap").read_bytes()[:end] == data[:end]
    assert (tmp_path / "new.mcap").stat().st_size == len(data)


def test_the_index_of_an_edited_file_finds_all_messages(tmp_path):
    old = everything(tmp_path / "old.mcap")
    edit(old, tmp_path / "new.mcap", ["rename-frame lidar=a_longer_name", "rename-frame base=b", "drop-topic /thing"])
    with (tmp_path / "new.mcap").open("rb") as stream:
        reader = make_reader(stream)
        by_index = [message.data for _, _, message in reader.iter_messages()]
    assert len(by_index) == recordings.COUNT + 1
    with coframe.open_bag(tmp_path / "new.mcap") as bag:
        assert not bag.problems
        assert set(bag.buffer.frame_names()) == {"odom", "b", "a_longer_name"}


def test_compression_is_chosen(tmp_path):
    old = everything(tmp_path / "old.mcap")
    result = run(old, "-o", tmp_path / "new.mcap", "--compression", "lz4", "--rename-frame", "base=b")
    assert result.exit_code == 0
    assert {each.compression for each in records(tmp_path / "new.mcap")[1].chunk_indexes} == {"lz4"}


@pytest.mark.parametrize("version", [1, 2, 3, 4])
def test_all_versions_of_sqlite(tmp_path, version):
    old = recordings.write_sqlite(tmp_path / "old" / "old.db3", version)
    edit(old, tmp_path / "new.db3", ["rename-frame base=base_link", "set-static base_link camera 1 0 0 0 0 0"])
    with coframe.open_bag(tmp_path / "new.db3") as bag:
        assert set(bag.buffer.frame_names()) == {"odom", "base_link", "lidar", "camera"}
    tables = []
    for path in (old, tmp_path / "new.db3"):
        with sqlite3.connect(path) as database:
            tables.append([database.execute(f"SELECT * FROM {name}").fetchall() for name in ("topics",)])
    assert tables[0] == tables[1]


def test_a_bag_of_ros1_becomes_mcap(tmp_path):
    old = recordings.write_rosbag1(tmp_path / "old.bag")
    result = run(old, "-o", tmp_path / "new", "--rename-frame", "base=base_link")
    assert result.exit_code == 0
    assert "coframe does not write ROS 1 bag" in result.stderr
    assert [at for _, at, _ in drives.contents(tmp_path / "new")] == [at for _, at, _ in recordings.messages()]
    assert [path.suffix for path in sorted((tmp_path / "new").iterdir())] == [".yaml", ".mcap"]


@pytest.mark.parametrize("plugin", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
@pytest.mark.parametrize("mode", [CompressionMode.FILE, CompressionMode.MESSAGE])
def test_compressed_files_and_messages(tmp_path, plugin, mode):
    if plugin is StoragePlugin.MCAP and mode is CompressionMode.MESSAGE:
        pytest.skip("rosbag2 does not write this")
    old = recordings.write_rosbag2(tmp_path / "old", plugin, mode)
    report = edit(old, tmp_path / "new", ["rename-frame base=base_link"])
    assert report.notes
    assert len(drives.contents(tmp_path / "new")) == recordings.COUNT + 1


def test_a_split_recording_stays_split(tmp_path):
    folder = tmp_path / "old"
    with coframe.bags.Writer(folder, max_duration="1s") as writer:
        topics = {}
        for topic, at, data in recordings.messages():
            topics.setdefault(topic, writer.add_topic(topic, recordings.TF))
            writer.write(topics[topic], data, at)
    edit(folder, tmp_path / "new", ["rename-frame base=base_link", "set-static base_link camera 1 0 0 0 0 0"])
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == [
        "metadata.yaml",
        "new_0.mcap",
        "new_1.mcap",
        "new_2.mcap",
    ]
    assert len(drives.contents(tmp_path / "new")) == len(drives.contents(folder)) + 1
    result = run(folder, "-o", tmp_path / "one.mcap", "--rename-frame", "base=base_link")
    assert (result.exit_code, "the recording has 3" in result.stderr) == (1, True)


def page():
    return (Path(__file__).parents[2] / "docs" / "how-to" / "repair.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("rule", [*re.findall(r"^\| `(--[^`]*)`", page(), re.MULTILINE), "--clock wall"])
def test_each_rule_of_the_page(tmp_path, rule):
    mixed = simulated(tmp_path / "mixed", StoragePlugin.MCAP, wall=set())
    (tmp_path / "FILE").mkdir()
    drives.write(tmp_path / "FILE" / "drive", Drive(seconds=1))
    words = [
        str(tmp_path / "FILE" / "drive") if word == "FILE" else word for word in shlex.split(rule.split("`, `")[0])
    ]
    if "#2" in rule:
        mixed = drives.write(tmp_path / "two", Drive(second=(0.5, 0.4)))
    result = run(mixed, "--dry-run", *words)
    assert result.exit_code in {0, NOTHING_MATCHED}, result.output


def test_the_page_names_all_rules():
    named = set(re.findall(r"`--([a-z-]+)", page()))
    assert named >= set(RULES)


def test_the_recipe_of_the_page(tmp_path):
    (tmp_path / "fix.yaml").write_text(re.search(r"```yaml\n(.*?)```", page(), re.DOTALL)[1])
    assert len(Recipe.load(tmp_path / "fix.yaml")) == 4


# Robustness


def test_a_damaged_recording_is_refused(tmp_path):
    old = everything(tmp_path / "old.mcap")
    data = old.read_bytes()
    old.write_bytes(data[: len(data) // 2])
    result = run(old, "-o", tmp_path / "new.mcap", "--rename-frame", "base=b")
    assert result.exit_code == 1
    assert "bag fix" in result.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["old.mcap"]


@pytest.mark.parametrize("seed", range(20))
def test_any_flipped_byte_is_refused_or_harmless(tmp_path, seed):
    random = np.random.default_rng(seed)
    old = everything(tmp_path / "old.mcap", list(CompressionType)[seed % 3], chunked=seed % 4 != 0)
    data = bytearray(old.read_bytes())
    for place in random.integers(8, len(data), 3):
        data[place] ^= 1 << int(random.integers(8))
    old.write_bytes(data)
    try:
        edit(old, tmp_path / "new.mcap", ["rename-frame base=b", "shift lidar=+1s", "dedupe", "rate /tf=10"])
    except coframe.CoframeError:
        assert not (tmp_path / "new.mcap").exists()


def test_a_damaged_message_is_copied_unchanged(tmp_path):
    rows = [
        (topic, at, data if number != 5 else data[:40])
        for number, (topic, at, data) in enumerate(recordings.messages())
    ]
    old = recordings.write_mcap(tmp_path / "old.mcap", rows=rows)
    report = edit(old, tmp_path / "new.mcap", ["rename-frame base=base_link"])
    assert any("cannot be decoded" in note for note in report.notes)
    assert records(tmp_path / "new.mcap")[0][5][-1] == rows[5][2]


def stream(path, megabytes):
    """Write a recording with this much data that does not compress."""
    random = np.random.default_rng(0)
    with coframe.bags.Writer(path, compression="none") as writer:
        tf = writer.add_topic("/tf", recordings.TF)
        image = writer.add_topic("/image", "sensor_msgs/msg/Image")
        pixels = random.integers(0, 255, 1 << 19).astype(np.uint8)
        for number in range(2 * megabytes):
            at = START + number * 10 * MS
            moved = drives.tf(drives.transform(at, "odom", "base_link", (number, 0, 0, 0, 0, 0, 1)))
            writer.write(tf, bytes(drives.store.serialize_cdr(moved, recordings.TF)), at)
            picture = drives.T["Image"](drives.header(at, "camera"), 512, 1024, "mono8", 0, 1024, pixels)
            writer.write(image, bytes(drives.store.serialize_cdr(picture, "sensor_msgs/msg/Image")), at)
    return path


MEMORY = """
import resource, sys
from coframe.bags import edit
edit(sys.argv[1], None, ["rename-frame camera=c"])
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
rules = ["rename-frame camera=front_camera", "shift base_link=+1s", "set-static base_link camera 0 0 0 0 0 0"]
edit(sys.argv[2], sys.argv[3], rules)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="resource")
def test_memory_does_not_grow_with_the_recording(tmp_path):
    small, large = stream(tmp_path / "small", 30), stream(tmp_path / "large", 300)
    command = [sys.executable, "-c", MEMORY, str(small), str(large), str(tmp_path / "new")]
    grown = int(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    assert grown < 40_000  # kilobytes; the recording has 300 000


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_edit_leaves_nothing(tmp_path, number):
    old = stream(tmp_path / "old", 200)
    command = [sys.executable, "-m", "coframe.cli", "bag", "edit", str(old), "-o", str(tmp_path / "new")]
    process = subprocess.Popen([*command, "--rename-frame", "camera=front_camera"], stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 60
    while not any(path.name.endswith(".part") for path in tmp_path.iterdir()):
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.005)
    process.send_signal(number)
    _, errors = process.communicate(timeout=60)
    assert process.returncode != 0
    assert "Traceback" not in errors
    assert sorted(path.name for path in tmp_path.iterdir()) == ["old"]
