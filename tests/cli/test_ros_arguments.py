# SPDX-License-Identifier: Apache-2.0
"""``--ros-args`` of commands that replace ROS 2's tools."""

import json
import subprocess
import sys

import pytest
from click.testing import CliRunner

from coframe.cli.app import app

REMAPPED = [
    "--ros-args",
    "-r",
    "__ns:=/robot1",
    "-r",
    "/tf_static:=mounts",
    "--log-level",
    "info",
    "-r",
    "__node:=mine",
]


@pytest.mark.usefixtures("domain_id")
def test_commands_are_remapped_as_the_tools_of_ros_are():
    pytest.importorskip("dds_library", reason="the commands speak DDS")
    from coframe.wire import Participant

    words = ["static", "--z", "0.5", "--frame-id", "base_link", "--child-frame-id", "lidar", *REMAPPED]
    static = subprocess.Popen([sys.executable, "-m", "coframe.cli", *words], stderr=subprocess.PIPE, text=True)
    try:
        assert "[mine]: Spinning until stopped" in static.stderr.readline()
        result = CliRunner().invoke(app, ["echo", "base_link", "lidar", "-l", "1", "--json", *REMAPPED])
        assert result.exit_code == 0, result.output
        assert json.loads(result.stdout)["translation"] == [0.0, 0.0, 0.5]
        participant = Participant.get()
        rules = ["--ros-args", "-r", "/tf_static:=/robot1/mounts", "-p", "use_sim_time:=false", "--"]
        for command in (
            ["frames", "--duration", "1s", *rules, "--json"],
            ["monitor", "--once", "--duration", "1s", *rules],
        ):
            result = CliRunner().invoke(app, command)
            assert result.exit_code == 0, result.output
            assert "lidar" in result.stdout
        assert ("/robot1", "mine") in participant.nodes()
        participant.close()
    finally:
        static.terminate()
        static.communicate(timeout=20)


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["-r"], "-r requires an argument."),
        (["-r", "__node"], "'__node' is not a remapping rule."),
        (["-r", "__node:=a/b"], "'__node:=a/b': 'a/b' is not a valid name."),
        (["-r", "__ns:=robot1"], "Namespaces begin with a slash: __ns:=/robot1"),
        (["--rate", "5"], "'--rate' is not a ROS argument."),
    ],
)
def test_invalid_arguments_end_the_command(words, reason):
    result = CliRunner().invoke(app, ["echo", "a", "b", "--ros-args", *words])
    assert result.exit_code == 2
    assert reason in result.stderr
