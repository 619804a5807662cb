"""The layout of ``--help``: usage, description, arguments and options, in at most 80 columns."""

from __future__ import annotations

from typing import Any

from typer.core import TyperCommand, TyperGroup

__all__ = ["PlainCommand", "PlainGroup"]


class PlainCommand(TyperCommand):
    """A command whose help names each argument as it is written on the command line: BAG, [BAG], TOPIC..."""

    def collect_usage_pieces(self, ctx: Any) -> list[str]:  # noqa: D102 - see the class
        return ["[OPTIONS]", *(_name(argument) for argument in _arguments(self, ctx))]

    def format_options(self, ctx: Any, formatter: Any) -> None:  # noqa: D102 - see the class
        arguments = [(_name(argument), _help(argument)) for argument in _arguments(self, ctx)]
        if arguments:
            with formatter.section("Arguments"):
                formatter.write_dl(arguments)
        _format_options(self, ctx, formatter)


class PlainGroup(TyperGroup):
    """A group of commands, each with its one-line description."""

    def format_options(self, ctx: Any, formatter: Any) -> None:  # noqa: D102 - see the class
        _format_options(self, ctx, formatter)
        self.format_commands(ctx, formatter)


def _format_options(command: Any, ctx: Any, formatter: Any) -> None:
    options = [each for each in command.get_params(ctx) if each.param_type_name == "option"]
    records = [record for each in options if (record := each.get_help_record(ctx)) is not None]
    with formatter.section("Options"):
        formatter.write_dl(records)


def _arguments(command: Any, ctx: Any) -> list[Any]:
    return [each for each in command.get_params(ctx) if each.param_type_name == "argument"]


def _name(argument: Any) -> str:
    name: str = argument.metavar or argument.name.upper()
    return name


def _help(argument: Any) -> str:
    text: str | None = getattr(argument, "help", None)
    return text or ""
