# SPDX-License-Identifier: Apache-2.0
"""A recording of two robots with the same frame names: each command reads only one of them, with a prefix."""

import json
import re

import pytest
from click.testing import CliRunner
from recordings import START
from runs import MS, SECOND, Run

import coframe
from coframe.cli.app import app

ROBOT1 = ["--tf-topic", "robot1/tf", "--tf-static-topic", "/robot1/tf_static", "--prefix", "robot1/", "--keep", "odom"]


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """Robot 1 is at x = 1 m, robot 2 at x = 2 m; each has a lidar."""
    run = Run()
    for x, name in enumerate(("robot1", "robot2"), 1):
        run.tf("base", "lidar", START, (0.0, 0.0, 0.5), static=True, topic=f"/{name}/tf_static")
        for i in range(50):
            at = START + i * SECOND // 50
            run.tf("odom", "base", at, (x, 0.0, 0.0), arrived=at + MS, topic=f"/{name}/tf")
        run.scan(START + SECOND // 2, arrived=START + SECOND // 2 + MS, topic=f"/{name}/scan")
    return run.write(tmp_path_factory.mktemp("bag"))


def run(*arguments):
    """Run a command; return its exit code and its output."""
    result = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert "Traceback" not in result.output
    return result.exit_code, result.stdout


def test_lookup_and_trajectory(bag):
    code, out = run("lookup", bag, "odom", "robot1/lidar", "--json", *ROBOT1)
    assert (code, json.loads(out)["translation"]) == (0, [1.0, 0.0, 0.5])
    robot2 = ["--tf-topic", "/robot2/tf", "--tf-static-topic", "/robot2/tf_static"]
    code, out = run("trajectory", bag, "odom", "lidar", *robot2)
    assert (code, {line.split()[1] for line in out.splitlines()}) == (0, {"2.0"})


def test_info_and_doctor_report_sensors_in_the_renamed_tree(bag):
    code, out = run("bag", "info", bag, "--json", *ROBOT1)
    report = json.loads(out)
    assert (code, [tree["root"] for tree in report["trees"]]) == (0, ["odom"])
    sensor = next(sensor for sensor in report["sensors"] if sensor["topic"] == "/robot1/scan")
    assert (sensor["frame"], sensor["possible"]) == ("robot1/lidar", 1)
    code, out = run("doctor", bag, "--json", *ROBOT1)
    report = json.loads(out)["namespaces"]["/robot1"]
    assert report["trees"] == {"odom": ["robot1/base", "robot1/lidar", "odom"]}
    assert {(sensor["frame"], sensor["root"]) for sensor in report["sensors"]} == {("robot1/lidar", "odom")}


def test_a_misspelled_topic_is_an_error(bag):
    for command in (["doctor", bag], ["frames", bag], ["lookup", bag, "odom", "base"]):
        result = CliRunner().invoke(app, [*map(str, command), "--tf-topic", "/robot3/tf"])
        assert result.exit_code == 1
        assert "has no topic /robot3/tf\n  Topics with transforms: /robot1/tf, /robot1/tf_static, " in result.stderr


def test_a_cloud(bag, tmp_path):
    code, out = run("cloud", bag, "/robot1/scan", "--frame", "robot1/base", "-o", tmp_path / "a.npz", *ROBOT1)
    assert (code, "of 1 message, in frame 'robot1/base'" in out) == (0, True)


@pytest.mark.slow  # It starts processes.
def test_a_batch(bag, tmp_path):
    pytest.importorskip("pyarrow")
    code, out = run("batch", "odom", "robot1/base", bag, "-o", tmp_path / "poses", *ROBOT1)
    assert (code, "50 poses from 1 recording" in out) == (0, True)


def test_bag_fix_gives_the_prefix_to_one_robot_only(bag, tmp_path):
    code, out = run("bag", "fix", bag, tmp_path / "new", *ROBOT1)
    assert (code, re.findall(r"fixed: (\S+): \d+ frame names?", out)) == (
        0,
        ["/robot1/tf_static", "/robot1/tf", "/robot1/scan"],
    )
    with coframe.open_bag(tmp_path / "new") as new:
        for topic, frame in (("/robot1/scan", "robot1/lidar"), ("/robot2/scan", "lidar")):
            assert [message.message.header.frame_id for message in new.messages(topic)] == [frame]
