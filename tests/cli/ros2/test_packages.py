# SPDX-License-Identifier: Apache-2.0
"""`coframe pkg`, `coframe doctor --report` and the commands that `ros2` refuses with a sentence."""

import re
import sys
import xml.etree.ElementTree as ET

import pytest

from coframe.cli.ros2 import executable

NODE = "/robot1/program"


def test_packages_of_coframe_are_listed(run):
    names = run("pkg", "list").splitlines()
    assert {"rclpy", "geometry_msgs", "launch_ros", "turtlesim"} <= set(names)
    assert names == sorted(names)
    assert run("pkg", "prefix", "geometry_msgs", "--share").strip().endswith("geometry_msgs")
    assert ET.fromstring(run("pkg", "xml", "turtlesim")).findtext("name") == "turtlesim"
    assert run("pkg", "xml", "rclpy", "--tag", "license") == "Apache-2.0\n"


def test_a_package_of_types_is_created_and_used(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    output = run("pkg", "create", "--build-type", "ament_cmake", "tutorial_kinds", "--dependencies", "geometry_msgs")
    assert "creating" in output
    manifest = ET.parse("tutorial_kinds/package.xml").getroot()
    assert manifest.findtext("export/build_type") == "ament_cmake"
    assert manifest.findtext("member_of_group") == "rosidl_interface_packages"
    assert "find_package(geometry_msgs REQUIRED)" in (tmp_path / "tutorial_kinds/CMakeLists.txt").read_text()
    (tmp_path / "tutorial_kinds/msg/Num.msg").write_text("int64 num\n")
    monkeypatch.setenv("COFRAME_INTERFACES", str(tmp_path))
    assert run("interface", "show", "tutorial_kinds/msg/Num") == "int64 num\n"
    words = ("pkg", "create", "--build-type", "ament_cmake", "more", "--node-name", "a")
    assert "cannot create C++ programs" in run(*words, code=2)
    assert "Types: ament_python, ament_cmake" in run("pkg", "create", "--build-type", "cmake", "more", code=2)


def test_the_report_shows_the_graph(run):
    output = run("doctor", "--report", "--duration", "0.5s", code=None)
    lines = [
        re.sub(r"\d+ (?=publishers|subscriptions|servers|clients)", "N ", line.strip()) for line in output.splitlines()
    ]
    assert NODE in lines
    assert "/chatter [std_msgs/msg/String]: N publishers, N subscriptions" in lines
    assert "/switch [std_srvs/srv/SetBool]: N servers, N clients" in lines
    assert "/lookup [tf2_msgs/action/LookupTransform]" in lines
    assert any(line.startswith("Python ") for line in lines)


@pytest.mark.parametrize("command", ["control", "trace", "security", "multicast", "plugin"])
def test_every_absent_command_has_a_sentence(command, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["ros2", command, "list"])
    monkeypatch.setattr(executable, "real_executable", lambda _name: None)
    with pytest.raises(SystemExit, match=f"The command {command} does not exist in coframe. ."):
        executable.ros2()
