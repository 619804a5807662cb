# SPDX-License-Identifier: Apache-2.0
"""Declarations of commands: click's decorators, and classes for features that click lacks.

These features are help for arguments, line wrapping that does not break names, suggestions for misspelled names, and
the option ``--wire`` of every command that joins the ROS graph.
"""

from __future__ import annotations

import functools
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

import click

from coframe._base_error import CoframeError
from coframe._output.formatting import error_text
from coframe._sources.urls import is_url
from coframe.cli import help_format
from coframe.cli.commands import joins_graph

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["PASS_ARGUMENTS_ON", "PATH", "RECORDING", "Argument", "Command", "CommandGroup", "Declared", "argument"]

Declared = TypeVar("Declared", bound="Callable[..., Any] | click.Command")

PATH: Final = click.Path(path_type=Path)


class _RecordingType(click.Path):
    """The type of arguments that are paths, or URLs of files."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return a path, or the file that a URL names."""
        if not is_url(value):
            return super().convert(value, param, ctx)
        from coframe._sources.sources import as_source  # noqa: PLC0415 - paths do not need it

        try:
            return as_source(value)
        except CoframeError as error:
            return self.fail(error_text(error), param, ctx)


RECORDING: Final = _RecordingType(path_type=Path)
# For commands that pass on unknown arguments: --ros-args to a node, NAME:=VALUE to a xacro file.
PASS_ARGUMENTS_ON: Final = {"ignore_unknown_options": True, "allow_extra_args": True}


class Argument(click.Argument):
    """An argument with a help text, or with a function that returns its help text."""

    def __init__(self, names: list[str], *, help: str | Callable[[], str] = "", **attributes: Any) -> None:  # noqa: A002 - click's name
        super().__init__(names, **attributes)
        self.help: Any = help  # Not available before click 8.5.


def argument(name: str, **attributes: Any) -> Callable[[Declared], Declared]:
    """Declare an argument as `click.argument` does; `help` is its help text."""
    return click.argument(name, cls=Argument, **attributes)


class Command(click.Command):
    """A command whose help shows each argument as it is written on the command line: BAG, [BAG] or TOPIC..."""

    def get_params(self, ctx: click.Context) -> list[click.Parameter]:
        """Return the parameters; before ``--help``, those of every command that joins the ROS graph."""
        params = super().get_params(ctx)
        if not joins_graph(_path(ctx)):
            return params
        own = len(self.params)
        return [*params[:own], _wire_option(), *params[own:]]

    def collect_usage_pieces(self, ctx: click.Context) -> list[str]:
        """Return the usage after the name of the command."""
        return ["[OPTIONS]", *help_format.argument_names(self, ctx)]

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the help: usage, description, arguments and options."""
        self.format_usage(ctx, formatter)
        help_format.write_description(self, formatter)
        help_format.write_arguments(self, ctx, formatter)
        help_format.write_options(self, ctx, formatter)


class CommandGroup(click.Group):
    """A group of commands, each with its one-line description."""

    command_class = Command

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """Return the names of the commands in the order of their declaration."""
        return list(self.commands)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command for the first word; suggest similar names for a misspelled one."""
        name = args[0]
        if not (name.startswith("-") or ctx.resilient_parsing or self.get_command(ctx, name)):
            from coframe._output.formatting import did_you_mean  # noqa: PLC0415 - the help does not need NumPy

            ctx.fail(f"No such command {name!r}. {did_you_mean(name, self.list_commands(ctx), limit=2)}".rstrip())
        return super().resolve_command(ctx, args)

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the help: usage, description, options and commands."""
        self.format_usage(ctx, formatter)
        help_format.write_description(self, formatter)
        help_format.write_options(self, ctx, formatter)
        help_format.write_section(formatter, "Commands", self.command_lines(ctx))

    def command_lines(self, ctx: click.Context) -> list[tuple[str, str]]:
        """Return the names of the commands with their summaries."""
        commands = ((name, self.get_command(ctx, name)) for name in self.list_commands(ctx))
        return [(name, command.short_help or "") for name, command in commands if command and not command.hidden]


def _path(ctx: click.Context) -> tuple[str, ...]:
    """Return the command path of a context, without the program name."""
    return () if ctx.parent is None else (*_path(ctx.parent), ctx.info_name or "")


@functools.cache
def _wire_option() -> click.Option:
    from coframe.wire import selection  # noqa: PLC0415 - the list of commands does not need DDS

    def check_name(name: str) -> str:
        if name not in selection.wires():
            raise click.BadParameter(f"{name!r} is not {selection.alternatives()}.")
        return name

    def choose(_ctx: click.Context, _parameter: click.Parameter, name: str | None) -> None:
        if name is not None:
            selection.choose(name)

    return click.Option(
        ["--wire"],
        metavar=f"[{'|'.join(selection.wires())}]",
        type=check_name,
        callback=choose,
        expose_value=False,
        is_eager=True,
        help=f"Middleware to use. [default: ${selection.VARIABLE}, or {selection.DEFAULT.title}]",
    )
