# SPDX-License-Identifier: Apache-2.0
"""Elements of launch files that Jazzy, Kilted and Lyrical have added, and details of Humble's."""

import io
import os
from pathlib import Path

import pytest

from launch import LaunchContext, LaunchDescription, LaunchService
from launch.actions import (
    DeclareBooleanLaunchArgument,
    Log,
    LogError,
    OpaqueFunction,
    PopEnvironment,
    PushEnvironment,
    ReplaceEnvironmentVariables,
)
from launch.frontend import Parser
from launch.frontend.parse_substitution import parse_substitution
from launch.logging import launch_config
from launch.utilities import perform_substitutions
from launch_ros.utilities import evaluate_parameters, normalize_parameters


def run(description):
    service = LaunchService()
    service.include_launch_description(description)
    return service.run()


def description_of(text):
    entity, parser = Parser.load(io.StringIO(text))
    return parser.parse_description(entity)


def test_log_actions_of_all_levels(capsys):
    text = """<launch><log message="a" level="warning"/><log message="b"/><log_debug message="c"/>
    <log_info message="d"/><log_warning message="e"/>
    <log_error message="f"/><log message="$(string-join - x y)" level="ERROR"/></launch>"""
    run(description_of(text))
    lines = [line for line in capsys.readouterr().out.splitlines() if "launch.user" in line]
    assert lines == [
        f"[{level}] [launch.user]: {message}"
        for level, message in (
            ("WARNING", "a"),
            ("INFO", "b"),
            ("INFO", "d"),
            ("WARNING", "e"),
            ("ERROR", "f"),
            ("ERROR", "x-y"),
        )
    ]
    with pytest.raises(KeyError, match="Invalid log level 'LOUD', expected: DEBUG"):
        Log(msg="a", level="loud").execute(LaunchContext())
    assert LogError(msg="a").execute(LaunchContext()) is None


def test_the_format_of_the_screen_is_set_and_reset(capsys):
    launch_config.set_screen_format("<{message}>")
    LogError(msg="one").execute(LaunchContext())
    launch_config.reset()
    LogError(msg="two").execute(LaunchContext())
    assert capsys.readouterr().out.splitlines() == ["<one>", "[ERROR] [launch.user]: two"]
    assert launch_config.get_screen_handler() is launch_config.get_screen_handler()


def test_substitutions_that_join():
    def performed(text):
        return perform_substitutions(LaunchContext(), parse_substitution(text))

    assert performed("$(string-join , a b 'c d')") == "a,b,c d"
    assert performed("$(path-join /a $(string-join _ b c) d.yaml)") == str(Path("/a", "b_c", "d.yaml"))
    with pytest.raises(TypeError, match="expects at least 2 arguments: 1 delimiter"):
        parse_substitution("$(string-join ,)")
    assert "demo_nodes_py.talker:main" in Path(performed("$(exec-in-pkg talker demo_nodes_py)")).read_text()


def test_boolean_arguments():
    argument = DeclareBooleanLaunchArgument("on", default_value="true")
    assert argument.choices == ["true", "false", "True", "False", "TRUE", "FALSE"]
    context = LaunchContext()
    argument.execute(context)
    assert context.launch_configurations["on"] == "true"
    context.launch_configurations["on"] = "maybe"
    with pytest.raises(RuntimeError, match='provided value "maybe" is not valid'):
        argument.execute(context)
    with pytest.raises(ValueError, match="Cannot specify choices for bool_arg"):
        DeclareBooleanLaunchArgument("on", choices=["a"])
    with pytest.raises(RuntimeError, match="Cannot specify choices for bool_arg"):
        description_of('<launch><bool_arg name="a"><choice value="b"/></bool_arg></launch>')
    assert description_of('<launch><bool_arg name="a" default="False"/></launch>').get_launch_arguments()[0].name == "a"


def test_the_environment_is_replaced():
    seen = {}
    run(
        LaunchDescription(
            [
                PushEnvironment(),
                ReplaceEnvironmentVariables({"ONLY": "this"}),
                OpaqueFunction(function=lambda _context: seen.update(os.environ)),
                PopEnvironment(),
            ]
        )
    )
    assert seen == {"ONLY": "this"}
    assert "PATH" in os.environ


@pytest.mark.parametrize(
    ("attributes", "value"),
    [
        ('value="1"', 1),
        ('value="1" type="str"', "1"),
        ('value="$(string-join x 1 1)" type="str"', "1x1"),
        ('value="$(eval 4)" type="float"', 4.0),
        ('value="1;2" value-sep=";" type="list_of_str"', ["1", "2"]),
        ('value="true" type="bool"', True),
    ],
)
def test_the_type_of_a_parameter(attributes, value):
    text = f'<launch><node pkg="p" exec="e"><param name="m" {attributes}/></node></launch>'
    (found,) = evaluate_parameters(LaunchContext(), _parameters(text))
    assert found == {"m": value}
    assert type(found["m"]) is type(value)


def test_an_unknown_type_of_a_parameter():
    text = '<launch><node pkg="p" exec="e"><param name="m" value="1" type="text"/></node></launch>'
    with pytest.raises(RuntimeError, match="'text' is not a type of a parameter, expected one of: bool, int"):
        description_of(text)


def test_parameters_keep_their_order(tmp_path):
    file = tmp_path / "p.yaml"
    text = f'<launch><node pkg="p" exec="e"><param name="m" value="1"/><param from="{file}"/></node></launch>'
    first, second = evaluate_parameters(LaunchContext(), _parameters(text))
    assert (first, second) == ({"m": 1}, file)


def test_streams_of_both_formats_are_recognized():
    for text in ("launch:\n- log: {message: hello}\n", '<launch><log message="hello"/></launch>'):
        assert len(description_of(text).entities) == 1


def test_normalized_parameters_are_a_tuple():
    assert isinstance(normalize_parameters([{"a": 1}]), tuple)


def _parameters(text):
    (node,) = description_of(text).entities
    return node._Node__parameters
