# SPDX-License-Identifier: Apache-2.0
"""Each command in backquotes in coframe's hints, messages and docstrings exists, with its subcommands and options."""

import ast
import re
import shlex
from pathlib import Path

import click
import pytest

from coframe.cli.app import app

PACKAGE = Path(__file__).parents[2] / "src/coframe"
PLACEHOLDER = "NAME"  # for a value that is only known when the text is printed


def texts(tree):
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            yield "".join(part.value if isinstance(part, ast.Constant) else PLACEHOLDER for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value


def hinted_commands():
    """Return where each command is first mentioned."""
    found = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        source = path.read_text(encoding="utf-8")
        if "`coframe " not in source:
            continue
        for text in texts(ast.parse(source)):
            for command in re.findall(r"`coframe\s+([^`]+)`", text):
                found.setdefault(" ".join(command.split()), str(path.relative_to(PACKAGE)))
    return found


def problem_of(text):
    """Return what is wrong with a command, or "" if its command, subcommands and options exist."""
    words = shlex.split(text)
    command, context = app, click.Context(app, info_name="coframe")
    while words and isinstance(command, click.Group) and not words[0].startswith("-") and words[0] != PLACEHOLDER:
        name = words.pop(0)
        found = command.get_command(context, name)
        if found is None:
            return f"{context.command_path} has no command {name!r}"
        command, context = found, click.Context(found, info_name=name, parent=context)
    options = {
        option for parameter in command.get_params(context) for option in (*parameter.opts, *parameter.secondary_opts)
    }
    unknown = [word for word in words if word.startswith("--") and word.partition("=")[0] not in options]
    return f"{context.command_path} has no option {', '.join(unknown)}" if unknown else ""


def test_each_command_in_a_text_exists():
    commands = hinted_commands()
    assert len(commands) > 60
    problems = {
        f"{where}: coframe {text}": problem for text, where in commands.items() if (problem := problem_of(text))
    }
    assert problems == {}


@pytest.mark.parametrize("text", ["fram", "bag repair", "doctor --fixx", "calib convert --kind X"])
def test_a_wrong_command_is_noticed(text):
    assert problem_of(text)
