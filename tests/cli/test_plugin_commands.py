# SPDX-License-Identifier: Apache-2.0
"""Commands of another distribution, which pip installs: they work, and what is wrong with them stays theirs."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("hatchling", reason="builds the distribution")

PROJECT = """\
[build-system]
requires = ["hatchling"]
build-backend = "hatchling.build"

[project]
name = "robot-greetings"
version = "1.0"

[project.entry-points."coframe.commands"]
greet = "robot_greetings:greet"
stumble = "robot_greetings:stumble"
lost = "robot_greetings:lost"
number = "robot_greetings:NUMBER"
absent = "robot_absent:absent"
slow = "robot_slow:slow"
doctor = "robot_greetings:greet"

[tool.hatch.build.targets.wheel]
only-include = ["robot_greetings.py", "robot_slow.py"]
"""
MODULE = '''\
import click
import coframe

NUMBER = 7


@click.command()
@click.argument("robot")
@click.option("--loud", is_flag=True, help="Greet in capital letters.")
def greet(robot, loud):
    """Greet ROBOT.

    Example: coframe greet marvin
    """
    text = f"Hello, {robot}."
    click.echo(text.upper() if loud else text)


@click.command()
def stumble():
    raise RuntimeError("a wheel\\nis missing")


@click.command()
def lost():
    coframe.Buffer().lookup("map", "nowhere")
'''
# Longer than the test may take.
SLOW = "import time\ntime.sleep(600)\n"


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The folder into which pip has installed the distribution."""
    source, folder = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("installed")
    for name, text in (("pyproject.toml", PROJECT), ("robot_greetings.py", MODULE), ("robot_slow.py", SLOW)):
        (source / name).write_text(text, encoding="utf-8")
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-build-isolation", "--no-deps"]
    subprocess.run([*pip, "--target", folder, source], check=True, capture_output=True, text=True)
    return folder


@pytest.fixture
def coframe(installed, tmp_path):
    """Run a command where the distribution is installed."""

    def run(*words, program="from coframe.cli import main", options=(), **environment):
        return subprocess.run(
            [sys.executable, *options, "-c", f"{program}; main()", *words],
            env={**os.environ, "PYTHONPATH": str(installed), "COLUMNS": "80", **environment},
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=100,
            check=False,
        )

    return run


def test_the_command_works_and_has_a_line_in_the_help(coframe):
    result = coframe("greet", "marvin", "--loud")
    assert (result.returncode, result.stdout, result.stderr) == (0, "HELLO, MARVIN.\n", "")
    assert "\n  greet       Command of the package robot-greetings.\n" in coframe("--help").stdout
    for flag in ("--help", "-h"):
        text = coframe("greet", flag).stdout
        assert "Example: coframe greet marvin" in text
        assert "--loud" in text
    wrong = coframe("gret", "marvin")
    assert wrong.returncode == 2
    assert "No such command 'gret'. Did you mean 'greet'?" in wrong.stderr


def test_the_help_lists_slow_and_broken_commands_without_their_import(coframe):
    result = coframe("--help")
    assert (result.returncode, result.stderr) == (0, "")
    for name in ("slow", "absent", "number"):
        assert f"\n  {name} " in result.stdout
    assert coframe("--version").returncode == 0
    assert result.stdout.count("\n  doctor ") == 1


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("absent", "cannot be loaded: ModuleNotFoundError: No module named 'robot_absent'."),
        ("number", "is not a click command, but 7."),
    ],
)
def test_a_command_that_cannot_be_loaded_ends_with_one_sentence(coframe, name, sentence):
    result = coframe(name)
    assert result.returncode == 1
    assert result.stderr.splitlines() == [
        f"coframe: The entry point '{name}' (coframe.commands) of the package robot-greetings {sentence}",
        "  Update the package, or uninstall it: pip uninstall robot-greetings",
    ]


def test_a_command_that_fails_ends_with_one_sentence(coframe):
    result = coframe("stumble")
    assert result.returncode == 1
    first, second = result.stderr.splitlines()
    assert first.endswith(r"robot-greetings has failed: RuntimeError: a wheel\nis missing.")
    assert second == "  Show the traceback with: python -X dev -m coframe.cli stumble ..."
    assert "Traceback" in coframe("stumble", options=("-X", "dev")).stderr
    result = coframe("lost")
    assert result.returncode == 1
    assert result.stderr.startswith('coframe: "map" passed to lookupTransform argument target_frame does not exist.')
    assert "Traceback" not in result.stderr


def test_the_names_of_coframe_are_taken(coframe):
    assert "Find problems with transforms" in coframe("--help").stdout
    assert "--explain" in coframe("doctor", "--help").stdout


def test_the_shell_completes_the_command_and_its_options(coframe):
    environment = {"_COFRAME_COMPLETE": "bash_complete", "COMP_CWORD": "1"}
    assert coframe(COMP_WORDS="coframe gre", **environment).stdout.split() == ["plain,greet"]
    environment["COMP_CWORD"] = "2"
    assert coframe(COMP_WORDS="coframe greet --lo", **environment).stdout.split() == ["plain,--loud"]


def test_ros2_has_its_own_commands_only(coframe):
    environment = {"AMENT_PREFIX_PATH": "", "PATH": str(Path(sys.executable).parent)}
    result = coframe("--help", program="from coframe.cli.ros2.executable import ros2 as main", **environment)
    assert "  topic " in result.stdout
    assert "greet" not in result.stdout
