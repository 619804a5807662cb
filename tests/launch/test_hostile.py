# SPDX-License-Identifier: Apache-2.0
"""Launch and parameter files that would need any time or memory end with an error message."""

import sys
from pathlib import Path

import pytest

pytest.importorskip("yaml")

from launch import LaunchContext
from launch.substitutions import Command
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch_xml import Parser as XmlParser
from launch_yaml import Parser as YamlParser
from rclpy import _yaml

BOMB = "a0: &a0 [x, x]\n" + "".join(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]\n" for n in range(1, 12))
YAML = {
    "bomb": (BOMB, "more than 262144 values"),
    "deep": ("[" * 50_000, "nested more than 100 levels deep"),
    "large": ("a: " + "x" * (17 << 20), "larger than the maximum of 16 MiB"),
}


@pytest.mark.parametrize("kind", YAML)
@pytest.mark.parametrize("read", [YamlParser.load, lambda path: list(_yaml.load_parameters(path))])
def test_yaml(tmp_path, kind, read):
    text, message = YAML[kind]
    path = tmp_path / "hostile.yaml"
    path.write_text(text)
    with pytest.raises(ValueError, match=message):
        read(str(path))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<launch>" + "<group>" * 5000, "nested more than 100 levels deep"),
        ("<launch>" + " " * (17 << 20) + "</launch>", "larger than the maximum of 16 MiB"),
        ('<!DOCTYPE l [<!ENTITY a "b">]><launch>&a;</launch>', "defines entities"),
        ("<launch>\x00</launch>", "not valid XML"),
        ('<?xml version="1.0" encoding="nonsense"?><launch/>', "not valid XML"),
    ],
)
def test_xml(tmp_path, text, message):
    path = tmp_path / "hostile.launch.xml"
    path.write_text(text)
    with pytest.raises(ValueError, match=message) as caught:
        XmlParser.load(str(path))
    assert str(path) in str(caught.value)


def test_keys_that_are_not_names(tmp_path):
    path = tmp_path / "params.yaml"
    path.write_text("node:\n  ros__parameters:\n    ? [a, b]\n    : 1\n")
    with pytest.raises(ValueError, match="Sequences cannot be key at line 3"):
        _yaml.load_parameters(str(path))


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux limits the memory")
@pytest.mark.parametrize("on_stderr", ["fail", "capture"])
def test_xacro_of_a_launch_file_has_the_limits_of_a_description(tmp_path, on_stderr):
    pytest.importorskip("xacro")
    program = Path(sys.executable).with_name("xacro")
    path = tmp_path / "bomb.xacro"
    path.write_text('<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><link name="${\'x\' * 10**10}"/></robot>')
    with pytest.raises(SubstitutionFailure, match="executed command failed"):
        Command([str(program), " ", str(path)], on_stderr=on_stderr).perform(LaunchContext())
    path.write_text('<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><link name="${1 + 1}"/></robot>')
    assert '<link name="2"/>' in Command([str(program), " ", str(path)], on_stderr=on_stderr).perform(LaunchContext())
