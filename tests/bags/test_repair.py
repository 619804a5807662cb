# SPDX-License-Identifier: Apache-2.0
"""Repaired copies of recordings: problems are reported and absent from the copy."""

import shutil

import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from recordings import COUNT, SECOND, START
from rosbags.rosbag2 import Reader
from runs import Run

import coframe
from coframe.bags import repair
from coframe.cli.app import app
from coframe.messages import find, serialize

ODOMETRY = "nav_msgs/msg/Odometry"


def fix(*arguments):
    result = CliRunner().invoke(app, ["bag", "fix", *map(str, arguments)])
    return result.exit_code, result.output


def assert_clean(path):
    """Assert that neither coframe nor rosbags reports a problem; return the messages."""
    result = CliRunner().invoke(app, ["bag", "info", str(path)])
    assert (result.exit_code, result.stderr) == (0, "")
    with Reader(path) as reader:
        return list(reader.messages())


def test_a_truncated_recording(tmp_path):
    cut = recordings.write_mcap(tmp_path / "cut.mcap", finish=False)
    cut.write_bytes(cut.read_bytes()[:3000])
    code, output = fix(cut, tmp_path / "new")
    assert code == 0
    assert "found: cut.mcap: truncated at byte 3000 of 3000" in output
    messages = assert_clean(tmp_path / "new")
    assert 20 < len(messages) < COUNT
    assert f"fixed: {len(messages)} messages on 2 topics copied, with an index and metadata.yaml" in output
    assert [bytes(data) for *_, data in messages] == [data for *_, data in recordings.messages()[: len(messages)]]


def test_progress_is_reported(tmp_path):
    reported = []
    repair(recordings.write_mcap(tmp_path / "a.mcap"), tmp_path / "new", progress=lambda *step: reported.append(step))
    assert list(dict.fromkeys(what for what, *_ in reported)) == ["reading", "writing", "checking"]
    last = {what: (done, total) for what, done, total in reported}
    assert last["writing"] == (COUNT + 1, COUNT + 1)
    assert all(done == total > 0 for done, total in last.values())


def test_metadata_that_list_other_files(shared, tmp_path):
    code, output = fix(shared / "recordings" / "broken" / "db3_renamed_metadata_stale", tmp_path / "new")
    assert code == 0
    assert "found: metadata.yaml lists rosbag2_2023_11_29-19_52_49_0.db3, which does not exist" in output
    assert len(assert_clean(tmp_path / "new")) == 191


@pytest.mark.parametrize(
    "name", ["tilt_laser.bag", "turtlesim_tf_demo_lz4.bag", "tb3_tf_missing_static", "world_talk_1hz"]
)
def test_repaired_real_recordings_contain_the_same_transforms(shared, tmp_path, name):
    repair(shared / "recordings" / name, tmp_path / "new")
    assert_clean(tmp_path / "new")
    with coframe.open_bag(shared / "recordings" / name) as old, coframe.open_bag(tmp_path / "new") as new:
        assert new.problems == []
        for before, after in zip(old.buffer.edges(), new.buffer.edges(), strict=True):
            assert before[:3] == after[:3]
            if before.parent:
                poses = [b.trajectory(before.parent, before.child).matrix for b in (old.buffer, new.buffer)]
                np.testing.assert_array_equal(*poses)


def test_leading_slashes_of_frame_names_are_removed(shared, tmp_path):
    report = repair(shared / "recordings" / "tilt_laser.bag", tmp_path / "new")
    assert "/tf: 1422 frame names stripped of leading slashes" in report.changes
    assert "/scan: 178 frame names stripped of leading slashes" in report.changes
    with coframe.open_bag(tmp_path / "new") as bag:
        assert bag.topics["/temperature"].messages == 712  # of a type that ROS 2 does not have
        assert not isinstance(next(bag.messages("/temperature")).message, bytes)
        assert {m.message.header.frame_id for m in bag.messages("/scan")} == {"laser"}


def messages_with_odometry():
    odometry = find(ODOMETRY)()
    odometry.header.frame_id, odometry.child_frame_id = "odom", "/base"
    return [*recordings.messages(), ("/odom", START + 3 * SECOND, serialize(odometry))]


def test_prefixes(tmp_path):
    source = recordings.write_mcap(
        tmp_path / "a.mcap", rows=messages_with_odometry(), types={"/odom": (ODOMETRY, "ros2msg", b"", "cdr")}
    )
    code, output = fix(source, tmp_path / "new", "--prefix", "r1/", "--keep", "odom")
    assert code == 0
    assert "fixed: /odom: 1 frame name given the prefix 'r1/'" in output
    assert_clean(tmp_path / "new")
    with coframe.open_bag(tmp_path / "new") as bag:
        poses = bag.buffer.trajectory("odom", "r1/lidar").matrix
        np.testing.assert_allclose(poses, recordings.expected().trajectory("odom", "lidar").matrix, rtol=0, atol=1e-15)
        odometry = next(bag.messages("/odom")).message
        assert (odometry.header.frame_id, odometry.child_frame_id) == ("odom", "r1/base")


def test_names_with_braces(tmp_path):
    source = recordings.write_mcap(
        tmp_path / "a.mcap",
        rows=[*recordings.messages(), ("/{x}{0.real}", START, b"")],
        types={"/{x}{0.real}": (ODOMETRY, "ros2msg", b"", "cdr")},
    )
    code, output = fix(source, tmp_path / "new", "--prefix", "{y}/")
    assert code == 0
    assert "frame names given the prefix '{y}/'" in output
    assert "/{x}{0.real}: 1 damaged message skipped" in output


def test_statics_come_first_and_from_another_recording(tmp_path):
    static, *moving = recordings.messages()
    late = recordings.write_mcap(tmp_path / "late.mcap", rows=[*moving, ("/tf_static", START + 9 * SECOND, static[2])])
    report = repair(late, tmp_path / "first")
    assert "/tf_static: 1 static transform moved to the beginning" in report.changes
    (first, _, data), *_ = assert_clean(tmp_path / "first")
    assert (first.topic, bytes(data)) == ("/tf_static", static[2])
    assert len(repair(tmp_path / "first", tmp_path / "again").changes) == 1

    without = recordings.write_mcap(tmp_path / "without.mcap", rows=moving)
    code, output = fix(without, tmp_path / "new", "--statics", late)
    assert code == 0
    assert "fixed: /tf_static: 1 static transform added" in output
    assert_clean(tmp_path / "new")
    with coframe.open_bag(tmp_path / "new") as bag:
        recordings.assert_same(bag.buffer)
    code, output = fix(without, tmp_path / "other", "--statics", without)
    assert code == 1
    assert "has no static transforms to add" in output


def test_statics_are_added_to_one_robot(tmp_path):
    run, plain = Run(), Run()
    run.tf("odom", "base", START, topic="/robot1/tf")
    run.tf("base", "camera", START, static=True, topic="/robot1/tf_static")
    run.tf("base", "lidar", START, static=True)  # of another robot with the same names
    for child in ("lidar", "camera"):
        plain.tf("base", child, START, static=True)
    (tmp_path / "plain").mkdir()
    robot1 = ["--tf-topic", "/robot1/tf", "--tf-static-topic", "robot1/tf_static", "--prefix", "robot1/"]
    code, output = fix(run.write(tmp_path), tmp_path / "new", "--statics", plain.write(tmp_path / "plain"), *robot1)
    assert code == 0
    assert "fixed: /robot1/tf_static: 1 static transform added" in output
    assert "1 static transform not added because the recording contains their frames" in output
    with coframe.open_bag(tmp_path / "new") as bag:
        assert bag.buffers["/robot1"].can_transform("robot1/odom", "robot1/lidar")
        assert [(edge.parent, edge.child) for edge in bag.buffers[""].edges() if edge.parent] == [("base", "lidar")]


def test_a_topic_without_a_leading_slash_belongs_to_the_robot(tmp_path):
    run = Run()
    run.tf("odom", "base", START, topic="tf")
    code, output = fix(run.write(tmp_path), tmp_path / "new", "--prefix", "robot1/")
    assert (code, "tf: 2 frame names given the prefix 'robot1/'" in output) == (0, True)


def test_rejected_transforms_and_damaged_messages_are_removed(tmp_path):
    nan = recordings.cdr("odom", "base", coframe.Transform(), START)[:-8] + b"\0" * 6 + b"\xf8\x7f"
    both = recordings.cdr("odom", "base", coframe.Transform(), START)
    rows = [*recordings.messages(), ("/tf", START, nan), ("/tf", START, b"\0\1\0\0cut"), ("/tf_static", START, both)]
    source = recordings.write_mcap(tmp_path / "a.mcap", rows=rows)
    with coframe.open_bag(source) as bag:
        assert len(bag.problems) == 3
    report = repair(source, tmp_path / "new")
    assert len(report.problems) == 3
    assert report.remaining == []
    assert "/tf: 1 transform removed that tf2 rejects as invalid" in report.changes
    assert "/tf: 1 damaged message skipped" in report.changes
    assert "/tf_static: 1 static transform of moving frames removed" in report.changes
    with coframe.open_bag(tmp_path / "new") as bag:
        recordings.assert_same(bag.buffer)


def test_remaining_problems_are_reported(tmp_path):
    rows = [*recordings.messages(), ("/own", START, b"\0\1\0\0abcd")]
    source = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/own": ("my_pkg/msg/Own", "", b"", "cdr")})
    code, output = fix(source, tmp_path / "new")
    assert code == 1
    assert "1 problem of the recording cannot be fixed in a copy" in output
    assert "remaining: /own: messages of type my_pkg/msg/Own are returned as bytes" in output
    with coframe.open_bag(tmp_path / "new") as bag:
        assert next(bag.messages("/own")).data == b"\0\1\0\0abcd"


@pytest.mark.parametrize(
    ("row", "remaining"),
    [
        (("/tf", START, recordings.cdr("world", "drone", coframe.Transform(), START)), "TF001"),
        (("/tf", START, recordings.cdr("odom", "base", coframe.Transform(), START - 3600 * 10**9)), "TF013"),
        (("/tf_static", START, recordings.cdr("lost", "lidar", coframe.Transform(), START)), "TF002"),
    ],
    ids=["separate tree", "gap", "two parents"],
)
def test_findings_that_a_copy_cannot_fix_are_listed(tmp_path, row, remaining):
    source = recordings.write_mcap(tmp_path / "a.mcap", rows=[*recordings.messages(), row])
    code, output = fix(source, tmp_path / "new")
    assert (code, f"remaining: {remaining}" in output) == (1, True), output
    assert (tmp_path / "new" / "metadata.yaml").exists()


def test_nothing_is_overwritten(tmp_path):
    source = recordings.write_mcap(tmp_path / "a.mcap")
    before = source.read_bytes()
    shutil.copy(source, tmp_path / "b.mcap")
    assert fix(source, tmp_path)[0] == 1
    code, output = fix(source, tmp_path / "b.mcap")
    assert code == 1
    assert "already exists and is not overwritten" in output
    code, output = fix(tmp_path / "gone", tmp_path / "new")
    assert code == 1
    assert not (tmp_path / "new").exists()
    assert fix(source, tmp_path / "new", "--compression", "zip")[0] == 2
    assert source.read_bytes() == (tmp_path / "b.mcap").read_bytes() == before
