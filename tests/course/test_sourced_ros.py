# SPDX-License-Identifier: Apache-2.0
"""Where a ROS 2 is sourced, a student's nodes run on it, and the grade is the same.

One test uses a stand-in for a sourced ROS 2. The other one needs a real one: `make test-ros` where it is sourced, or
`make test-ros-wheels`, which installs rclpy and Fast DDS of ROS 2 Kilted with pip.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import ros_stand_in
from grades import lost  # of this folder

from coframe.workspace import ros_folders

# The first lines of each program: they end it unless rclpy and the messages are those of the sourced ROS 2.
GUARD = """
import os, rclpy, tf2_ros, geometry_msgs.msg, sensor_msgs.msg, tf2_msgs.msg
for module in (rclpy, tf2_ros, geometry_msgs.msg, sensor_msgs.msg, tf2_msgs.msg):
    assert {condition}, f"{{module.__name__}} is that of {{module.__file__}}"
"""


def grade(folder, condition, environment, *only):
    """Return the report of a folder whose programs end unless a condition on each of their ROS modules holds."""
    for program in folder.glob("*.py"):
        program.write_text(GUARD.format(condition=condition) + program.read_text())
    command = [sys.executable, "-m", "coframe.cli", "lab", "check", folder, "--json"]
    command += [word for criterion in only for word in ("--only", criterion)]
    result = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=500, check=False)
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


@pytest.mark.slow
def test_nodes_run_with_the_sourced_packages(folder, tmp_path):
    ros_stand_in.make(tmp_path / "ros")
    condition = f"module.__file__.startswith({str(tmp_path)!r})"
    only = ("static", "dynamic", "listener", "sensor")
    report = grade(folder, condition, ros_stand_in.environment(tmp_path / "ros"), *only)
    assert [(each["problem"], lost(each)) for each in report["criteria"]] == [("", {})] * 4


@pytest.mark.slow
def test_nodes_that_would_run_with_coframe_are_noticed(folder):
    report = grade(folder, "'nowhere' in module.__file__", os.environ, "static")
    assert report["earned"] == 0
    assert "rclpy is that of" in report["criteria"][0]["problem"]


@pytest.mark.skipif("COFRAME_TEST_ROS" not in os.environ, reason="needs a sourced ROS 2: make test-ros")
@pytest.mark.timeout(600)
def test_grade_on_ros_2(folder):
    import rclpy

    ours = str(ros_folders.ros_folder())
    assert not str(Path(rclpy.__file__)).startswith(ours), "no ROS 2 is sourced"
    report = grade(folder, f"not module.__file__.startswith({ours!r})", os.environ)
    assert [(each["problem"], lost(each)) for each in report["criteria"]] == [("", {})] * 9
    assert (report["earned"], report["bonus"]) == (100, 40)
