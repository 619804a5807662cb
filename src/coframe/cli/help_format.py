# SPDX-License-Identifier: Apache-2.0
"""The layout of ``--help``: usage, description, arguments and options as plain text of at most 80 columns."""

from __future__ import annotations

import inspect
import re
import textwrap
from typing import TYPE_CHECKING, Final

import click

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["argument_names", "write_arguments", "write_description", "write_options", "write_section"]

_INDENT: Final = "  "
_NAME_WIDTH: Final = 26  # Longer names are on a separate line.
# Help texts state ranges in words where needed.
_RANGE: Final = re.compile(r"  \[(?:[-\d.]+<=?)?x(?:[<>]=?[-\d.]+)?\]|; (?:[-\d.]+<=?)?x(?:[<>]=?[-\d.]+)?(?=\])")


def argument_names(command: click.Command, ctx: click.Context) -> list[str]:
    """Return the names of the arguments as the usage shows them."""
    return [argument.human_readable_name for argument in _arguments(command, ctx)]


def write_description(command: click.Command, formatter: click.HelpFormatter) -> None:
    """Write the description of a command, which may have several paragraphs."""
    for paragraph in inspect.cleandoc(command.help or "").split("\n\n"):
        formatter.write("\n" + _wrap(paragraph, _INDENT, _INDENT, formatter.width) + "\n")


def write_arguments(command: click.Command, ctx: click.Context, formatter: click.HelpFormatter) -> None:
    """Write the arguments of a command with their help texts."""
    rows = [(_unbracketed_name(each), _text(each)) for each in _arguments(command, ctx)]
    write_section(formatter, "Arguments", rows)


def write_options(command: click.Command, ctx: click.Context, formatter: click.HelpFormatter) -> None:
    """Write the options of a command with their help texts."""
    options = (each for each in command.get_params(ctx) if isinstance(each, click.Option))
    records = filter(None, (option.get_help_record(ctx) for option in options))
    write_section(formatter, "Options", [(name, _RANGE.sub("", text)) for name, text in records])


def write_section(formatter: click.HelpFormatter, title: str, rows: list[tuple[str, str]]) -> None:
    """Write a title and, below it, two columns: names, and descriptions wrapped to the width of the terminal."""
    if not rows:
        return
    column = len(_INDENT) + 2 + max((len(name) for name, _ in rows if len(name) <= _NAME_WIDTH), default=0)
    formatter.write(f"\n{title}:\n")
    for name, text in rows:
        start = f"{_INDENT}{name}"
        if len(start) > column - 2:
            formatter.write(start + "\n")
            start = ""
        formatter.write(_wrap(text, start.ljust(column), " " * column, formatter.width).rstrip() + "\n")


def _arguments(command: click.Command, ctx: click.Context) -> Iterator[click.Argument]:
    return (each for each in command.get_params(ctx) if isinstance(each, click.Argument))


def _text(argument: click.Argument) -> str:
    """Return the help text of an argument, which a function computes if it depends on installed packages."""
    text = getattr(argument, "help", None) or ""
    return str(text() if callable(text) else text)


def _unbracketed_name(argument: click.Argument) -> str:
    """Return the name without a bracket that spans several arguments, as in [TARGET SOURCE]."""
    name = argument.human_readable_name
    return name if name.count("[") == name.count("]") else name.strip("[]")


def _wrap(text: str, first: str, rest: str, width: int) -> str:
    """Wrap text only at spaces, because a break inside `--tf-topic` would be misread."""
    words = " ".join(text.split())
    return textwrap.fill(
        words, width, initial_indent=first, subsequent_indent=rest, break_on_hyphens=False, break_long_words=False
    )
