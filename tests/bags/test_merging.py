# SPDX-License-Identifier: Apache-2.0
"""Merged recordings: the topics of two robots stay apart, and it is said which topics were joined."""

import pytest
from click.testing import CliRunner
from recordings import START
from runs import MS, SECOND, Run

import coframe
from coframe.bags import copy_recordings
from coframe.cli.app import app
from coframe.doctor import diagnose, observe_recording
from coframe.messages import find

SCAN, TWIST = "sensor_msgs/msg/LaserScan", "geometry_msgs/msg/Twist"


def robot(folder, x, prefix="", root="map", later=0):
    """Write the recording of a robot at x with a lidar, commands and a log."""
    run = Run()
    run.tf(f"{prefix}base", f"{prefix}lidar", START, (0.0, 0.0, 0.5), static=True)
    for i in range(100):
        at = START + i * SECOND // 50 + round(x * MS) + later
        run.tf(root, f"{prefix}base", at, (x, i / 100, 0.0), arrived=at + MS)
        if i % 5 == 0:
            run.scan(at, f"{prefix}lidar", arrived=at + MS)
            run.message("/cmd_vel", TWIST, find(TWIST)(), at)
            run.message("/rosout", "rcl_interfaces/msg/Log", find("rcl_interfaces/msg/Log")(), at)
    folder.mkdir()
    return run.write(folder)


def merge(*words):
    ended = CliRunner().invoke(app, ["bag", "merge", *map(str, words)])
    return ended.exit_code, ended.stderr


@pytest.fixture
def same(tmp_path):
    return robot(tmp_path / "a", 1.0), robot(tmp_path / "b", 2.0)


@pytest.fixture
def prefixed(tmp_path):
    return robot(tmp_path / "a", 1.0, "robot1/"), robot(tmp_path / "b", 2.0, "robot2/")


def contents(path):
    with coframe.open_bag(path) as bag:
        return {name: (topic.messages, bag.first_frame(name)) for name, topic in bag.topics.items()}


APART = {
    "/tf": (200, ""),
    "/tf_static": (2, ""),
    "/rosout": (40, ""),
    "/robot1/scan": (20, "robot1/lidar"),
    "/robot2/scan": (20, "robot2/lidar"),
    "/robot1/cmd_vel": (20, ""),
    "/robot2/cmd_vel": (20, ""),
}


def test_prefixes_of_an_option_apply_to_frames_and_topics(same, tmp_path):
    code, said = merge(*same, "-o", tmp_path / "both", "--prefix", "robot1/", "--prefix", "robot2/", "--keep", "map")
    assert (code, said) == (0, "")
    assert contents(tmp_path / "both") == APART
    with coframe.open_bag(tmp_path / "both") as bag:
        for name, x in (("robot1", 1.0), ("robot2", 2.0)):
            assert bag.buffer.lookup("map", f"{name}/lidar").translation[0] == x
    (observation,) = observe_recording(tmp_path / "both").values()
    assert diagnose(observation).healthy


def test_topics_of_recordings_with_prefixed_frames_stay_apart(prefixed, tmp_path):
    code, said = merge(*prefixed, "-o", tmp_path / "both")
    assert (code, contents(tmp_path / "both")) == (0, APART)
    assert "/scan: kept apart as /robot1/scan, /robot2/scan, because the frames have different prefixes" in said


def test_topics_of_one_robot_are_joined_and_named(tmp_path):
    parts = robot(tmp_path / "a", 1.0), robot(tmp_path / "b", 1.0, later=3 * SECOND)
    report = copy_recordings(parts, tmp_path / "both")
    assert report.notes == ["/cmd_vel: joined from 2 recordings", "/scan: joined from 2 recordings"]
    assert contents(tmp_path / "both")["/scan"] == (40, "lidar")


def test_robots_with_the_same_names_are_an_error_with_the_ways_out(same, tmp_path):
    code, said = merge(*same, "-o", tmp_path / "both")
    assert (code, (tmp_path / "both").exists()) == (1, False)
    assert "were recorded at the same time, and 2 names would be mixed up: frame base, topic /scan" in said
    assert "Give each recording a prefix for its frames and topics, such as robot1/, or a namespace" in said
    assert "join the names" in said
    assert merge(*same, "-o", tmp_path / "both", "--join")[0] == 0


def test_robots_in_one_namespace_are_an_error_too(tmp_path):
    bags = []
    for name, x in (("a", 1.0), ("b", 2.0)):
        run = Run()
        for i in range(100):
            at = START + i * SECOND // 50 + round(x * MS)
            run.tf("map", "base", at, (x, i / 100, 0.0), arrived=at + MS, topic="/fleet/tf")
        (tmp_path / name).mkdir()
        bags.append(run.write(tmp_path / name))
    code, said = merge(*bags, "-o", tmp_path / "both")
    assert (code, "1 name would be mixed up: frame base" in said) == (1, True)


def test_two_recorders_of_one_robot_are_joined(tmp_path):
    one = robot(tmp_path / "a", 1.0)
    assert merge(one, one, "-o", tmp_path / "both")[0] == 0


def test_namespaces_keep_the_frames_and_separate_the_topics(same, tmp_path):
    words = ("--namespace", "/robot1", "--namespace", "robot2/")
    assert merge(*same, "-o", tmp_path / "both", *words) == (0, "")
    with coframe.open_bag(tmp_path / "both") as bag:
        assert set(bag.topics) == {
            "/rosout",
            *(f"/robot{n}/{name}" for n in (1, 2) for name in ("tf", "tf_static", "scan", "cmd_vel")),
        }
        assert [bag.buffers[f"/robot{n}"].lookup("map", "lidar").translation[0] for n in (1, 2)] == [1.0, 2.0]
    code, said = merge(*same, "-o", tmp_path / "other", "--namespace", "/robot1")
    assert (code, "--namespace: give one for each of the 2 recordings" in said) == (2, True)
    code, said = merge(*same, "-o", tmp_path / "other", "--namespace", "/a b", "--namespace", "/c")
    assert (code, said) == (2, "coframe: --namespace: '/a b' is not a namespace such as /robot1\n")
    with pytest.raises(ValueError, match="is not a namespace"):
        copy_recordings(same, tmp_path / "other", namespaces=["/a b", ""])


def test_joined_topics_with_different_frames_are_said_to_differ(tmp_path):
    bags = robot(tmp_path / "a", 1.0, "robot1/"), robot(tmp_path / "b", 2.0, "")
    code, said = merge(*bags, "-o", tmp_path / "both")
    assert (code, "1 name would be mixed up: topic /scan" in said) == (1, True)
    _, said = merge(*bags, "-o", tmp_path / "both", "--join")
    assert "/scan: joined from 2 recordings, with messages in 'lidar', 'robot1/lidar': prefixes keep those" in said
    (observation,) = observe_recording(tmp_path / "both").values()
    assert "TF028" in {finding.code for finding in diagnose(observation).every_finding()}


def test_parts_of_one_recording_with_prefixed_frames_are_joined(tmp_path):
    bags = robot(tmp_path / "a", 1.0, "robot1/"), robot(tmp_path / "b", 2.0, "robot1/", later=3 * SECOND)
    assert contents(copy_recordings(bags, tmp_path / "both").path)["/scan"] == (40, "robot1/lidar")


def test_frames_without_a_prefix_below_the_root_leave_the_topics_joined(tmp_path):
    run = Run()
    run.tf("map", "dock", START, static=True)
    (tmp_path / "dock").mkdir()
    bags = robot(tmp_path / "a", 1.0, "robot1/"), run.write(tmp_path / "dock")
    assert copy_recordings(bags, tmp_path / "both").notes == []
    assert "/scan" in contents(tmp_path / "both")


def test_each_definition_of_a_type_keeps_its_messages(tmp_path):
    """Two versions of a message of the team: each is decoded by the definition that it was recorded with."""
    definitions = {"a": "int32 x\nint32 y\n", "b": "int32 y\nint32 x\n"}
    for name, text in definitions.items():
        with coframe.bags.Writer(tmp_path / name) as writer:
            topic = writer.add_topic("/point", "team_msgs/msg/Point", definition=text)
            data = bytes([0, 1, 0, 0]) + (7).to_bytes(4, "little") + (9).to_bytes(4, "little")
            writer.write(topic, data, START + (name == "b"))
    copy_recordings([tmp_path / "a", tmp_path / "b"], tmp_path / "both")
    with coframe.open_bag(tmp_path / "both") as bag:
        assert [(one.message.x, one.message.y) for one in bag.messages("/point")] == [(7, 9), (9, 7)]


@pytest.mark.parametrize("prefixes", [["robot1/"], ["robot1/", "/robot2"]])
def test_wrong_prefixes_are_refused(same, tmp_path, prefixes):
    code, said = merge(*same, "-o", tmp_path / "both", *(word for each in prefixes for word in ("--prefix", each)))
    assert (code, "--prefix" in said) == (2, True)
    with pytest.raises(ValueError, match="prefix"):
        copy_recordings(same, tmp_path / "both", prefixes=prefixes)


def test_frames_of_messages_that_cannot_be_renamed_are_named(tmp_path):
    bags = []
    for name in ("a", "b"):
        with coframe.bags.Writer(tmp_path / name) as writer:
            topic = writer.add_topic(
                "/fix", "gnss.Fix", encoding="json", definition="{}", definition_format="jsonschema"
            )
            writer.write(topic, b'{"frame_id": "gnss"}', START)
        bags.append(tmp_path / name)
    report = copy_recordings(bags, tmp_path / "both", prefixes=["r1/", "r2/"])
    assert report.problems == ["/fix: frame names in gnss.Fix were not given the prefix"]
    assert set(contents(report.path)) == {"/r1/fix", "/r2/fix"}
