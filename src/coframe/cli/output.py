# SPDX-License-Identifier: Apache-2.0
"""Printing for all commands: errors, warnings, log lines, and text that is safe for a terminal."""

from __future__ import annotations

import re
import sys
import time
from typing import IO, TYPE_CHECKING, Any, NoReturn, cast

import click
from click.exceptions import Exit

from coframe._files.bounded_lines import print_bounded
from coframe._files.os_errors import reason
from coframe._output.escaping import one_line, printable
from coframe.cli.system_errors import writing_advice
from coframe.time import SECOND

if TYPE_CHECKING:
    from pathlib import Path

    from rich.console import Console

__all__ = [
    "awaited_statics_text",
    "fail",
    "fail_to_write",
    "for_command_line",
    "log",
    "one_line",
    "print_bounded",
    "printable",
    "report_console",
    "warn",
]

_REDIRECTED_WIDTH = 1000  # columns
# An argument in a text of the library, but not within a call such as Buffer(cache="30s").
_ARGUMENT = re.compile(r"(?<![\w(-])([a-z][a-z0-9_]*)=(\"[^\"]*\"|True|\d+(?:\.\d+)?)?")


def fail(text: str, hint: str = "", *, code: int = 1, details: str = "") -> NoReturn:
    """Print a one-line error, details and what to do, and end the command with this exit code."""
    click.echo(f"coframe: {one_line(text)}", err=True)
    if details:
        click.echo(printable(details), err=True)
    if hint:
        click.echo(f"  {one_line(for_command_line(hint))}", err=True)
    raise Exit(code)


def fail_to_write(path: Path | None, error: OSError, *, code: int = 1) -> NoReturn:
    """End the command because a file (or, without a path, standard output) could not be written."""
    name = "standard output" if path is None else path
    fail(f"{name} cannot be written: {reason(error)}", writing_advice(error), code=code)


def for_command_line(text: str) -> str:
    """Return a text of the library in the spelling of the running command.

    Arguments become its options, and a doctor code becomes the command that prints its page.
    """
    context = click.get_current_context(silent=True)
    options = {parameter.name for parameter in context.command.params} if context else set()

    def option(argument: re.Match[str]) -> str:
        name, value = argument.groups()
        if name not in options:
            return argument[0]
        return f"--{name.replace('_', '-')}" + (f" {value.strip(chr(34))}" if value and value != "True" else "")

    return re.sub(r"See doctor code (TF\d+)\.", r"More: coframe doctor --explain \1", _ARGUMENT.sub(option, text))


def awaited_statics_text(nodes: list[str]) -> str:
    """Return a warning about publishers of static transforms that were discovered but have not delivered them."""
    return (
        f"The static transforms of {', '.join(nodes)} have not arrived yet. Run the command again if a frame is "
        f"missing."
    )


def warn(text: str) -> None:
    """Print a warning on stderr."""
    print_bounded(f"coframe: {printable(text)}", error=True)


def log(level: str, node: str, text: str) -> None:
    """Print a line on stderr in the format of ROS's console logger, without control characters."""
    seconds, nanoseconds = divmod(time.time_ns(), SECOND)
    print_bounded(f"[{level}] [{seconds}.{nanoseconds:09d}] [{node}]: {printable(text)}", error=True)


def report_console() -> Console:
    """Return the console for tables; without a terminal, cells are not truncated and lines do not end with spaces."""
    from rich.console import Console  # noqa: PLC0415 - commands without tables start faster

    console = Console(highlight=False)
    if console.is_terminal:
        return console
    return Console(file=cast("IO[str]", _WithoutTrailingSpaces()), highlight=False, width=_REDIRECTED_WIDTH)


class _WithoutTrailingSpaces:
    """Writes to standard output without trailing spaces, which tables add in the last column."""

    def write(self, text: str) -> int:
        return sys.stdout.write(re.sub(r" +$", "", text, flags=re.MULTILINE))

    def __getattr__(self, name: str) -> Any:
        return getattr(sys.stdout, name)
