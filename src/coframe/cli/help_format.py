# SPDX-License-Identifier: Apache-2.0
"""The layout of ``--help``: usage, description, arguments and options as plain text of at most 80 columns."""

from __future__ import annotations

import inspect
import re
import textwrap
from typing import Any

from typer.core import TyperCommand, TyperGroup

from coframe.cli import wire_option

__all__ = ["PlainCommand", "PlainGroup"]

_INDENT = "  "
_NAME_WIDTH = 26  # Longer names have a line of their own.
# The help texts state ranges in words where users need them.
_RANGE = re.compile(r"  \[(?:[-\d.]+<=?)?x(?:[<>]=?[-\d.]+)?\]|; (?:[-\d.]+<=?)?x(?:[<>]=?[-\d.]+)?(?=\])")


class PlainCommand(TyperCommand):
    """A command whose help names each argument as it is written on the command line: BAG, [BAG] or TOPIC..."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse the arguments; suggest the correct name of a misspelled option as of a misspelled command."""
        if wire_option.joins_graph(ctx):
            try:
                args = wire_option.take_wire(args, leading_only=ctx.info_name == "run")
            except ValueError as error:
                ctx.fail(str(error))
        try:
            words: list[str] = super().parse_args(ctx, args)
        except Exception as error:
            # The class is private in the versions of typer that contain their own click.
            if type(error).__name__ == "NoSuchOption" and getattr(error, "possibilities", None):
                near = sorted(error.possibilities)  # type: ignore[attr-defined]
                error.message = f"{error.message.rstrip('.')}. Did you mean {' or '.join(near)}?"  # type: ignore[attr-defined]
                error.possibilities = None  # type: ignore[attr-defined]
            raise
        return words

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """Return the words after the name of the command."""
        return ["[OPTIONS]", *(_name(argument) for argument in _parameters(self, ctx, "argument"))]

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help: usage, description, arguments and options."""
        self.format_usage(ctx, formatter)
        _write_description(self, formatter)
        self.format_options(ctx, formatter)

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the arguments and the options."""
        arguments = [(_whole_name(argument), argument.help or "") for argument in _parameters(self, ctx, "argument")]
        _write_section(formatter, "Arguments", arguments)
        options = _option_records(self, ctx)
        if wire_option.joins_graph(ctx):
            options.insert(-1, wire_option.HELP)  # before --help
        _write_section(formatter, "Options", options)


class PlainGroup(TyperGroup):
    """A group of commands, each with its one-line description."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help: usage, description, arguments and options."""
        self.format_usage(ctx, formatter)
        _write_description(self, formatter)
        self.format_options(ctx, formatter)

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the options and the commands."""
        _write_section(formatter, "Options", _option_records(self, ctx))
        commands = {name: self.get_command(ctx, name) for name in self.list_commands(ctx)}
        _write_section(
            formatter, "Commands", [(name, each.short_help or "") for name, each in commands.items() if each]
        )


def _option_records(command: Any, ctx: Any) -> list[tuple[str, str]]:
    records = [option.get_help_record(ctx) for option in _parameters(command, ctx, "option")]
    # Some versions of typer escape brackets for rich.
    return [(name, _RANGE.sub("", (text or "").replace("\\[", "["))) for name, text in filter(None, records)]


def _parameters(command: Any, ctx: Any, kind: str) -> list[Any]:
    return [each for each in command.get_params(ctx) if each.param_type_name == kind]


def _name(argument: Any) -> str:
    name: str = argument.metavar or argument.name.upper()
    return name


def _whole_name(argument: Any) -> str:
    """Return the name without a bracket that belongs to several arguments, as in [TARGET SOURCE]."""
    name = _name(argument)
    return name if name.count("[") == name.count("]") else name.strip("[]")


def _write_description(command: Any, formatter: Any) -> None:
    for paragraph in inspect.cleandoc(command.help or "").split("\n\n"):
        formatter.write("\n" + _wrapped(paragraph, _INDENT, _INDENT, formatter.width) + "\n")


def _write_section(formatter: Any, title: str, rows: list[tuple[str, str]]) -> None:
    """Write a title and, below it, two columns: names, and texts that are wrapped to the width of the terminal."""
    if not rows:
        return
    column = len(_INDENT) + 2 + max((len(name) for name, _ in rows if len(name) <= _NAME_WIDTH), default=0)
    formatter.write(f"\n{title}:\n")
    for name, text in rows:
        start = f"{_INDENT}{name}".ljust(column)
        if len(start) > column:
            formatter.write(start + "\n")
            start = " " * column
        formatter.write(_wrapped(text, start, " " * column, formatter.width).rstrip() + "\n")


def _wrapped(text: str, first: str, rest: str, width: int) -> str:
    """Wrap a text at spaces only: a break inside `--tf-topic` would be misread."""
    words = " ".join(text.split())
    return textwrap.fill(
        words, width, initial_indent=first, subsequent_indent=rest, break_on_hyphens=False, break_long_words=False
    )
