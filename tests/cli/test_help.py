# SPDX-License-Identifier: Apache-2.0
"""The help of every command."""

import re

import pytest
from click.testing import CliRunner

from coframe.cli.app import app
from coframe.cli.commands import COMMANDS


def all_commands(command, words=()):
    """Yield the words that call each command and each group."""
    yield words
    for name, child in getattr(command, "commands", {}).items():
        yield from all_commands(child, (*words, name))


EVERY_COMMAND = list(all_commands(app))


def help_of(words, monkeypatch, columns="80"):
    monkeypatch.setenv("COLUMNS", columns)
    result = CliRunner().invoke(app, [*words, "--help"], prog_name="coframe")
    assert result.exit_code == 0, result.output
    return result.output


def test_every_command_is_covered():
    assert {words[0] for words in EVERY_COMMAND if words} == set(COMMANDS)
    assert ("bag", "fix") in EVERY_COMMAND


@pytest.mark.parametrize("words", EVERY_COMMAND, ids=" ".join)
def test_help_has_an_example_and_plain_value_names(words, monkeypatch):
    text = help_of(words, monkeypatch)
    assert re.search(rf"^  Example: coframe {' '.join(words)}", text, re.MULTILINE)
    # click's own value names are types, such as <str> or <int range>.
    assert not re.search(r"<(bool|str|int|float|path|list|choice)\b", text)
    assert not re.search(r"\b(TEXT|INTEGER|FLOAT|PATH)\b", text)
    assert "default: ()" not in text


@pytest.mark.parametrize("words", EVERY_COMMAND, ids=" ".join)
def test_help_fits_into_80_columns(words, monkeypatch):
    text = help_of(words, monkeypatch)
    assert [line for line in text.splitlines() if len(line) > 80] == []
    assert "..." not in re.sub(r"\b[A-Z]+\]?\.\.\.", "", text), "a text is cut off"


@pytest.mark.parametrize("words", EVERY_COMMAND, ids=" ".join)
def test_help_describes_every_argument_and_option(words, monkeypatch):
    _, _, sections = help_of(words, monkeypatch).partition("  Example: ")
    lines = sections.splitlines()
    rows = [
        (line, following)
        for line, following in zip(lines, [*lines[1:], ""], strict=True)
        if re.match(r"  (-|\[?[A-Z]+\b)", line)
    ]
    assert rows
    for line, following in rows:
        described = re.search(r"\S {2,}\S", line) or re.match(r" {10,}\S", following)
        assert described, f"no text for {line.strip()}"


def test_options_of_the_same_name_have_the_same_text():
    texts = {}
    pending = [app]
    while pending:
        command = pending.pop()
        pending += getattr(command, "commands", {}).values()
        if command.name == "run":
            continue  # Its --prefix is a command, as in ros2 run.
        for parameter in command.params:
            if parameter.name in {"prefixes", "namespaces"}:
                continue  # Those of merged recordings also apply to topics.
            for name in {"--domain", "--keep", "--namespace", "--port", "--prefix"} & set(parameter.opts):
                texts.setdefault(name, set()).add((parameter.metavar, parameter.help))
    assert len(texts) == 5
    assert all(len(variants) == 1 for variants in texts.values()), texts


def test_short_option_of_the_help(monkeypatch):
    for words in ((), ("lab",), ("topic", "echo"), ("static",)):
        assert CliRunner().invoke(app, [*words, "-h"], prog_name="coframe").output == help_of(words, monkeypatch)


def test_unknown_commands_and_options_are_reported():
    for words, text in ((["frobnicate"], "No such command"), (["doctor", "--color"], "No such option")):
        result = CliRunner().invoke(app, words)
        assert result.exit_code == 2
        assert text in result.output
