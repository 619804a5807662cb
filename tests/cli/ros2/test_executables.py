# SPDX-License-Identifier: Apache-2.0
"""The executables `ros2`, `rviz2` and `launch_test`: coframe's commands, unless a real ROS is installed."""

import os
import subprocess
import sys

import pytest


@pytest.fixture
def execute(tmp_path):
    """Run an executable with words; return its exit code and output."""

    def run(name, *words, **environment):
        script = f"from coframe.cli.ros2.executable import {name}; {name}()"
        result = subprocess.run(
            [sys.executable, "-c", script, *words],
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
            cwd=tmp_path,
            env={**os.environ, "PATH": os.defpath, "AMENT_PREFIX_PATH": "", **environment},
        )
        return result.returncode, result.stdout + result.stderr

    return run


def test_help_and_commands_without_a_counterpart(execute):
    code, output = execute("ros2", "--help")
    assert code == 0
    assert output.startswith("Usage: ros2 [OPTIONS] COMMAND")
    assert {"topic", "node", "run", "launch", "bag"} <= set(output.split())
    assert "\n  view " not in output
    assert execute("ros2", "daemon", "status") == (
        0,
        "coframe has no daemon: each command reads the ROS graph itself.\n",
    )
    code, output = execute("ros2", "control", "list_controllers")
    assert code == 1
    assert "The controllers of ros2_control are C++ programs" in output
    code, output = execute("ros2", "topics")
    assert code == 2
    assert "Did you mean 'topic'" in output


def test_a_real_ros2_takes_precedence(execute, tmp_path):
    real = tmp_path / "bin" / "ros2"
    real.parent.mkdir()
    real.write_text('#!/bin/sh\necho "real $@"\n')
    real.chmod(0o755)
    assert execute("ros2", "topic", "list", PATH=f"{real.parent}:{os.defpath}") == (0, "real topic list\n")
    assert execute("ros2", "x", AMENT_PREFIX_PATH=str(tmp_path)) == (0, "real x\n")
    real.write_text("#!/usr/bin/env python3\nfrom coframe.cli.ros2.executable import ros2\nros2()\n")
    code, output = execute("ros2", "--help", PATH=f"{real.parent}:{os.defpath}")
    assert (code, output.split()[:2]) == (0, ["Usage:", "ros2"])


def test_run_starts_the_executables_of_packages(execute):
    code, output = execute("ros2", "run", "tf2_ros", "tf2_echo", "--help")
    assert code == 0
    assert "TARGET_FRAME" in output
    code, output = execute("ros2", "pkg", "executables", "tf2_ros")
    assert "tf2_ros static_transform_publisher" in output.splitlines()


def test_tests_of_launched_systems(execute, tmp_path):
    code, output = execute("ros2", "test", "missing.py")
    assert (code, output.splitlines()[-1]) == (2, "launch_test: error: Test file 'missing.py' does not exist")
    (tmp_path / "empty.py").touch()
    code, output = execute("launch_test", "empty.py")
    assert code == 2
    assert "launch_test: error: Test file 'empty.py' is missing generate_test_description function" in output


def test_rviz2_opens_the_viewer(execute):
    code, output = execute("rviz2", "-d", "missing.rviz", "-f", "map", "--ros-args", "-r", "a:=b")
    assert code != 0
    assert "missing.rviz" in output
    assert "Traceback" not in output
    code, output = execute("rviz2", "--bogus")
    assert code == 2
    assert "coframe view --help" in output


def test_executables_are_added_and_removed(tmp_path):
    """In a separate environment; an existing executable of a real ROS is not touched."""
    environment = tmp_path / "environment"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", environment], check=True)
    python = environment / "bin" / "python"
    paths = os.pathsep.join(path for path in sys.path if path)

    def coframe(*words):
        result = subprocess.run(
            [python, "-m", "coframe.cli", "ros2", *words],
            capture_output=True,
            text=True,
            check=True,
            env={**os.environ, "PYTHONPATH": paths, "PATH": os.defpath, "AMENT_PREFIX_PATH": str(tmp_path / "ros")},
        )
        return result.stdout

    real = tmp_path / "ros" / "bin" / "rviz2"
    real.parent.mkdir(parents=True)
    real.write_text("#!/bin/sh\n")
    real.chmod(0o755)
    output = coframe("install")
    assert f"created {environment}/bin/ros2" in output
    assert f"rviz2: {real} already exists and is not replaced" in output
    result = subprocess.run(
        [environment / "bin" / "ros2", "--help"],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": paths, "PATH": os.defpath, "AMENT_PREFIX_PATH": ""},
    )
    assert result.stdout.startswith("Usage: ros2")
    assert f"removed {environment}/bin/ros2" in coframe("remove")
    assert not (environment / "bin" / "ros2").exists()


def test_options_of_ros2_bag(execute):
    code, output = execute("ros2", "bag", "play", "missing", "-s", "mcap", "-l", "-p", "-d", "1")
    assert code == 1
    assert "missing" in output
    assert "No such option" not in output


@pytest.mark.slow
def test_a_new_package_runs_without_a_build(execute, tmp_path):
    code, output = execute(
        "ros2", "pkg", "create", "my_robot", "--node-name", "hello", "--dependencies", "rclpy", "std_msgs"
    )
    assert code == 0, output
    manifest = (tmp_path / "my_robot" / "package.xml").read_text()
    assert "<depend>rclpy</depend>\n  <depend>std_msgs</depend>" in manifest
    assert execute("ros2", "pkg", "executables", "my_robot") == (0, "my_robot hello\n")
    assert execute("ros2", "pkg", "xml", "my_robot", "--tag", "version") == (0, "0.0.0\n")
    code, output = execute("ros2", "pkg", "create", "my_robot")
    assert code == 1
    assert "already exists" in output
    assert execute("ros2", "pkg", "create", "My-Robot")[0] == 2
    compile((tmp_path / "my_robot" / "my_robot" / "hello.py").read_text(), "hello.py", "exec")
    metadata = subprocess.run(
        [sys.executable, "setup.py", "--name"], cwd=tmp_path / "my_robot", capture_output=True, text=True, check=True
    )
    assert metadata.stdout.splitlines()[-1] == "my_robot"


def test_definitions_of_types(execute):
    code, output = execute("ros2", "interface", "show", "geometry_msgs/msg/PointStamped")
    assert code == 0
    assert output.splitlines() == [
        "std_msgs/Header header",
        "\tbuiltin_interfaces/Time stamp",
        "\t\tint32 sec",
        "\t\tuint32 nanosec",
        "\tstring frame_id",
        "Point point",
        "\tfloat64 x",
        "\tfloat64 y",
        "\tfloat64 z",
    ]
    code, output = execute("ros2", "interface", "show", "geometry_msgs/msg/Pnt")
    assert code == 1
    assert "Did you mean 'geometry_msgs/msg/Point" in output
    assert "    std_srvs/srv/SetBool" in execute("ros2", "interface", "list")[1].splitlines()
    assert execute("ros2", "interface", "proto", "std_msgs/msg/String") == (0, "\"data: ''\n\"\n")
