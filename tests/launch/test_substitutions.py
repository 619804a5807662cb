# SPDX-License-Identifier: Apache-2.0
"""Substitutions and conditions, in Python and as text of XML and YAML files."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from launch.conditions import IfCondition, LaunchConfigurationEquals, LaunchConfigurationNotEquals, UnlessCondition
from launch.frontend import Parser
from launch.substitutions import (
    AllSubstitution,
    AndSubstitution,
    AnonName,
    AnySubstitution,
    BooleanSubstitution,
    Command,
    EnvironmentVariable,
    EqualsSubstitution,
    FileContent,
    FindExecutable,
    IfElseSubstitution,
    LaunchConfiguration,
    LocalSubstitution,
    NotEqualsSubstitution,
    NotSubstitution,
    OrSubstitution,
    PathJoinSubstitution,
    PathSubstitution,
    PythonExpression,
    StringJoinSubstitution,
    SubstitutionFailure,
    TextSubstitution,
    ThisLaunchFile,
    ThisLaunchFileDir,
)

PYTHON = f"'{sys.executable}'"


@pytest.mark.parametrize(
    ("substitution", "text"),
    [
        ("plain", "plain"),
        (["a", TextSubstitution(text="b"), LaunchConfiguration("robot")], "abrover"),
        (LaunchConfiguration("missing", default="x"), "x"),
        (LaunchConfiguration("missing", default=5), "5"),
        (LaunchConfiguration(["ro", "bot"]), "rover"),
        (
            PathJoinSubstitution(["a", ["b", LaunchConfiguration("robot")], "c.yaml"]),
            str(Path("a/brover/c.yaml")),
        ),
        (PathSubstitution("a") / "b" / "c", str(Path("a/b/c"))),
        (StringJoinSubstitution(["a", "b"], delimiter="-"), "a-b"),
        (EnvironmentVariable("COFRAME_TEST"), "set"),
        (EnvironmentVariable("COFRAME_NOT_SET", default_value=["d", "e"]), "de"),
        (PythonExpression(["1 + ", "2"]), "3"),
        (PythonExpression(["'", LaunchConfiguration("robot"), "' == 'rover'"]), "True"),
        (PythonExpression("round(sin(pi / 2) + math.cos(0))"), "2"),
        (PythonExpression("os.sep == '/' or True", python_modules=["os"]), "True"),
        (LocalSubstitution("event.name"), "launch.Event"),
        (LocalSubstitution("values['a'][1]"), "2"),
        (NotSubstitution("False"), "true"),
        (AndSubstitution("true", "0"), "false"),
        (OrSubstitution("false", "1"), "true"),
        (AnySubstitution("false", "false", "on"), "true"),
        (AllSubstitution("true", "no"), "false"),
        (BooleanSubstitution("ON"), "true"),
        (EqualsSubstitution(LaunchConfiguration("robot"), "rover"), "true"),
        (EqualsSubstitution("1", "true"), "true"),
        (EqualsSubstitution("1.0", 1), "true"),
        (NotEqualsSubstitution("a", "b"), "true"),
        (IfElseSubstitution(LaunchConfiguration("on"), "yes", "no"), "yes"),
        (IfElseSubstitution("false", if_value="yes"), ""),
        (ThisLaunchFile(), "/ws/launch/a.launch.py"),
        (ThisLaunchFileDir(), "/ws/launch"),
        (Command([PYTHON, " -c 'print(6 * 7)'"]), "42\n"),
        (Command([PYTHON, " -c 'import sys; sys.stderr.write(\"x\"); print(1)'"], on_stderr="ignore"), "1\n"),
        (Command([PYTHON, " -c 'import sys; sys.stderr.write(\"x\")'"], on_stderr="capture"), "x"),
    ],
)
def test_substitutions(context, perform, monkeypatch, substitution, text):
    from launch import Event

    monkeypatch.setenv("COFRAME_TEST", "set")
    context.launch_configurations.update({"robot": "rover", "on": "true"})
    context.extend_locals(
        {
            "current_launch_file_path": "/ws/launch/a.launch.py",
            "current_launch_file_directory": "/ws/launch",
            "event": Event(),
            "values": {"a": [1, 2]},
        }
    )
    assert perform(substitution) == text


@pytest.mark.parametrize(
    ("substitution", "message"),
    [
        (LaunchConfiguration("robto"), "launch configuration 'robto' does not exist. Did you mean 'robot'?"),
        (EnvironmentVariable("COFRAME_NOT_SET"), "environment variable 'COFRAME_NOT_SET' does not exist"),
        (FindExecutable(name="no-such-program"), "executable 'no-such-program' not found on the PATH"),
        (Command("no-such-program x"), "executable 'no-such-program' not found on the PATH. Command: no-such"),
        (Command([PYTHON, " -c 'raise SystemExit(3)'"]), "executed command failed. Command: "),
        (Command([PYTHON, " -c 'import sys; sys.stderr.write(\"oh\")'"]), "executed command showed stderr output"),
        (PythonExpression("1 / 0"), "PythonExpression '1 / 0' failed: ZeroDivisionError: division by zero"),
        (FileContent("/no/such/file"), "Failed to open substitution file: /no/such/file"),
        (NotSubstitution("maybe"), "'maybe' is not a truth value; write true or false"),
        (ThisLaunchFileDir(), "ThisLaunchFileDir used outside of a launch file"),
        (LocalSubstitution("a.b"), "context.locals has no value 'a.b'"),
    ],
)
def test_failures_of_substitutions(context, perform, substitution, message):
    context.launch_configurations["robot"] = "rover"
    with pytest.raises(SubstitutionFailure) as caught:
        perform(substitution)
    assert message in str(caught.value)


def test_anonymous_names_are_names_of_nodes_and_the_same_in_one_launch(perform):
    from rclpy.validate_node_name import validate_node_name

    first = perform(AnonName("talker"))
    assert first.startswith("talker_")
    assert first == perform(AnonName("talker")) != perform(AnonName("listener"))
    assert validate_node_name(first)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("plain text", "plain text"),
        ("$(var robot)_$(var no 'a b')", "rover_a b"),
        (r"\$(var robot) costs 5\\6", r"$(var robot) costs 5\6"),
        ("$(env COFRAME_TEST_ENV unset)", "unset"),
        ("$(eval '1 + 1')", "2"),
        ("$(eval \"'$(var robot)' == 'rover'\")", "True"),
        ("$(if $(var on) $(var robot) none)", "rover"),
        ("$(not $(equals $(var robot) rover))", "false"),
        ("$(and true $(or false true))", "true"),
        ("$(any false true) $(all true false)", "true false"),
        ("$(not-equals a b)", "true"),
        ("$(dirname)/x", "/ws/x"),
        ("$(var $(var key))", "rover"),
        ("", ""),
        ("100 $ and a ) bracket", "100 $ and a ) bracket"),
    ],
)
def test_text_with_substitutions(context, text, expected):
    context.launch_configurations.update({"robot": "rover", "on": "true", "key": "robot"})
    context.extend_locals({"current_launch_file_directory": "/ws"})
    Parser.load_launch_extensions()
    from launch.utilities import perform_substitutions

    assert perform_substitutions(context, Parser().parse_substitution(text)) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("$(vra x)", r"Unknown substitution: \$\(vra ...\). Did you mean 'var'"),
        ("$(var x", r"a '\)' is missing after"),
        ("$(var 'x)", "a closing ' is missing"),
        ("$()", "expected the name of a substitution"),
        ("$(eval 1 + 1)", "takes 1 to 2 arguments, not 3; put quotes around an argument that contains spaces"),
        ("$(var " * 2000, "expected the name of a substitution"),
    ],
)
def test_invalid_text(text, message):
    Parser.load_launch_extensions()
    with pytest.raises((ValueError, TypeError), match=message):
        Parser().parse_substitution(text)


def test_conditions(context):
    context.launch_configurations["mode"] = "fast"
    assert IfCondition(" TRUE ").evaluate(context)
    assert not IfCondition("0").evaluate(context)
    assert UnlessCondition(["fal", "se"]).evaluate(context)
    assert IfCondition(EqualsSubstitution(LaunchConfiguration("mode"), "fast")).evaluate(context)
    assert LaunchConfigurationEquals("mode", "fast").evaluate(context)
    assert LaunchConfigurationEquals("other", None).evaluate(context)
    assert LaunchConfigurationNotEquals("mode", "slow").evaluate(context)
    with pytest.raises(RuntimeError, match="invalid condition expression 'maybe', expected one of: "):
        IfCondition("maybe").evaluate(context)


def test_the_error_of_xacro_comes_first(perform, tmp_path):
    pytest.importorskip("xacro")
    head = '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    for text, error in (
        ('<link name="${nope}"/></robot>', "error: name 'nope' is not defined"),
        ("<link", "XML parsing error: unclosed token"),
    ):
        file = tmp_path / "a.xacro"
        file.write_text(head + text)
        with pytest.raises(SubstitutionFailure, match=f"^{error}"):
            perform(Command(["xacro ", str(file)]))


def test_the_output_of_a_command_is_utf_8_whatever_the_system_uses(tmp_path):
    """Windows has another encoding, and so does a Python whose locale is not set."""
    description = tmp_path / "robot.py"
    description.write_bytes("print(\"<robot name='Gr\u00fcn'/>\")\n".encode())
    program = f"""
from launch import LaunchContext
from launch.substitutions import Command
command = Command([{PYTHON!r}, " -X utf8 ", {str(description)!r}])
print(ascii(command.perform(LaunchContext())))
"""
    settings = {"PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "LC_ALL": "C", "PYTHONPATH": ""}
    command = [sys.executable, "-c", program]
    output = subprocess.check_output(command, env={**os.environ, **settings}, text=True)
    assert output == ascii("<robot name='Gr\u00fcn'/>\n") + "\n"
