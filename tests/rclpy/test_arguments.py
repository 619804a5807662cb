# SPDX-License-Identifier: Apache-2.0
"""Parsing of `--ros-args`."""

import pytest

from rclpy import _arguments, _yaml
from rclpy._remapping import NameResolver, remap_node
from rclpy.exceptions import RCLInvalidROSArgsError, UnknownROSArgsError
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.utilities import remove_ros_args


def resolver(*rules: str, node: str = "arm", namespace: str = "/") -> NameResolver:
    words = [word for rule in rules for word in ("-r", rule)]
    return NameResolver(node, namespace, _arguments.parse(["--ros-args", *words]).remaps)


def test_arguments_outside_of_ros_args_are_ignored():
    args = ["prog", "x:=y", "--ros-args", "-r", "a:=b", "--", "-r", "c:=d", "--ros-args", "-p", "n:=1"]
    parsed = _arguments.parse(args)
    assert [rule.match for rule in parsed.remaps] == ["a"]
    assert [(item.name, item.value) for item in parsed.parameters] == [("n", 1)]
    assert remove_ros_args(args) == ["prog", "x:=y", "-r", "c:=d"]


@pytest.mark.parametrize(
    ("args", "error", "text"),
    [
        (["--bogus"], UnknownROSArgsError, "unknown ROS arguments: .'--bogus'"),
        (["-r"], RCLInvalidROSArgsError, "-r needs an argument"),
        (["-r", "chatter"], RCLInvalidROSArgsError, "does not have the form from:=to"),
        (["-r", "chatter:="], RCLInvalidROSArgsError, "no value after :="),
        (["-p", "rate"], RCLInvalidROSArgsError, "does not have the form"),
        (["--log-level", "loud"], RCLInvalidROSArgsError, "Known levels: debug, info"),
        (["--params-file", "/nowhere.yaml"], RCLInvalidROSArgsError, "No such file"),
    ],
)
def test_invalid_arguments_are_reported(args, error, text):
    with pytest.raises(error, match=text):
        _arguments.parse(["--ros-args", *args])


def test_logging_options():
    words = "--log-level warn --log-level arm.child:=DEBUG --disable-stdout-logs --disable-rosout-logs"
    words += " --enable-external-lib-logs --log-config-file x"
    logging = _arguments.parse(["--ros-args", *words.split()]).logging
    assert logging.default_level is LoggingSeverity.WARN
    assert logging.levels == {"arm.child": LoggingSeverity.DEBUG}
    assert (logging.stdout, logging.rosout) == (False, False)


def test_node_name_and_namespace_remapping():
    rules = _arguments.parse(["--ros-args", "-r", "__node:=left", "-r", "__ns:=/robots"]).remaps
    assert remap_node("arm", "/", rules) == ("left", "/robots")
    rules = _arguments.parse(["--ros-args", "-r", "arm:__name:=left", "-r", "leg:__ns:=/robots"]).remaps
    assert remap_node("arm", "/", rules) == ("left", "/")


@pytest.mark.parametrize(
    ("rule", "name", "expected"),
    [
        ("/tf:=tf", "/tf", "/robot1/tf"),
        ("chatter:=talk", "chatter", "/robot1/talk"),
        ("/robot1/chatter:=/talk", "chatter", "/talk"),
        ("chatter:=talk", "/chatter", "/chatter"),
        ("~/state:=/state", "~/state", "/state"),
        ("arm:chatter:=talk", "chatter", "/robot1/talk"),
        ("leg:chatter:=talk", "chatter", "/robot1/chatter"),
        ("rostopic://chatter:=talk", "chatter", "/robot1/talk"),
        ("rosservice://chatter:=talk", "chatter", "/robot1/chatter"),
    ],
)
def test_topic_remapping(rule, name, expected):
    assert resolver(rule, namespace="/robot1").resolve(name) == expected


def test_first_rule_applies_and_services_have_separate_rules():
    assert resolver("a:=first", "a:=second").resolve("a") == "/first"
    assert resolver("rosservice://a:=b").resolve("a", is_service=True) == "/b"
    assert resolver("a:=b").resolve("a", only_expand=True) == "/a"


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("true", True),
        ("no", False),
        ("5", 5),
        ("-0x10", -16),
        ("5.0", 5.0),
        ("1e-3", 0.001),
        ("abc", "abc"),
        ("'5'", "5"),
        ('"a b"', "a b"),
        ("", ""),
        ("[1, 2]", [1, 2]),
        ("[a, 'b, c', \"d\"]", ["a", "b, c", "d"]),
        ("[]", []),
        ("[1.0, .5]", [1.0, 0.5]),
        ("/a/b", "/a/b"),
    ],
)
def test_types_of_parameter_values(text, value):
    parsed = _yaml.parse_value(text)
    assert parsed == value
    assert type(parsed) is type(value)


def test_parameter_rules_match_node_names():
    [everywhere, named] = _arguments.parse(["--ros-args", "-p", "a:=1", "-p", "arm:b:=2"]).parameters
    assert everywhere.matches("/x/leg")
    assert named.matches("/arm")
    assert named.matches("/robot1/arm")
    assert not named.matches("/robot1/leg")


def test_parameter_files(tmp_path):
    pytest.importorskip("yaml")
    path = tmp_path / "params.yaml"
    path.write_text(
        "/**:\n  ros__parameters:\n    use: true\narm:\n  ros__parameters:\n    gain: {p: 1e3, i: '5'}\n"
        "robot1:\n  leg:\n    ros__parameters: {names: [a, b]}\n/*/hand:\n  ros__parameters: {size: 3}\n"
    )
    parameters = _arguments.parse(["--ros-args", "--params-file", str(path)]).parameters

    def of(node: str) -> dict:
        return {item.name: item.value for item in parameters if item.matches(node)}

    assert of("/arm") == {"use": True, "gain.p": 1000.0, "gain.i": "5"}
    assert of("/robot1/leg") == {"use": True, "names": ["a", "b"]}
    assert of("/x/hand") == {"use": True, "size": 3}
    assert of("/hand") == {"use": True}


def test_error_of_an_invalid_parameter_file_contains_its_name(tmp_path):
    pytest.importorskip("yaml")
    path = tmp_path / "params.yaml"
    path.write_text("arm: 5\n")
    with pytest.raises(RCLInvalidROSArgsError, match="ros__parameters"):
        _arguments.parse(["--ros-args", "--params-file", str(path)])
