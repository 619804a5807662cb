# SPDX-License-Identifier: Apache-2.0
"""The command line: coframe's commands and the commands of plug-ins, each imported when it is called."""

from __future__ import annotations

import functools
import importlib
import os
import sys
from typing import TYPE_CHECKING, Any

import click
from click.exceptions import Abort, Exit

import coframe
from coframe._base_error import CoframeError
from coframe._process.plugins import Plugin, PluginError, plugins
from coframe._process.signal_handlers import SIGINT_EXIT_CODE
from coframe.cli.commands import COMMANDS
from coframe.cli.declaration import CommandGroup
from coframe.distributions import NAMES, current

if TYPE_CHECKING:
    from collections.abc import Collection

    from click.shell_completion import CompletionItem

__all__ = ["PLUGINS", "CommandLine"]

PLUGINS = "coframe.commands"  # the entry point group whose objects are click commands
_DESCRIPTIONS = {
    "coframe": "ROS 2's transform system (tf2) as one pip install: any frame, any time, on any machine.\n\n"
    "Example: coframe demo",
    "ros2": "The ros2 commands that coframe provides if no ROS is installed. coframe --help lists more.\n\n"
    "Example: ros2 topic list",
}


class CommandLine(CommandGroup):
    """The commands of a program. A command's module is imported only when the command is called.

    Args:
        program: The name of the program.
        shown: The available commands. None for all, including those of plug-ins.
    """

    def __init__(self, program: str = "coframe", shown: Collection[str] | None = None) -> None:
        super().__init__(
            program,
            help=_DESCRIPTIONS[program],
            params=_options(),
            # The commands of ros2 also accept -h.
            context_settings={"help_option_names": ["--help", "-h"], "show_default": True},
        )
        self._rows = {name: row for name, row in COMMANDS.items() if shown is None or name in shown}
        self._has_plugins = shown is None

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """Return the names of coframe's commands, then of the plug-ins' commands."""
        return [*self._rows, *self._plugins]

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """Import a command.

        Raises:
            click.ClickException: The plug-in that adds the command cannot be loaded.
        """
        if cmd_name not in self.commands:
            if cmd_name in self._rows:
                self.commands[cmd_name] = self._load_own_command(cmd_name)
            elif cmd_name in self._plugins:
                self.commands[cmd_name] = _load_command(self._plugins[cmd_name])
        return self.commands.get(cmd_name)

    def command_lines(self, ctx: click.Context) -> list[tuple[str, str]]:  # noqa: ARG002
        """Return the names of the commands with their summaries."""
        own = [(name, row.line) for name, row in self._rows.items()]
        return [*own, *((name, _plugin_summary(plugin)) for name, plugin in self._plugins.items())]

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Return the names of commands or options that begin with a text."""
        from click.shell_completion import CompletionItem  # noqa: PLC0415 - only for completion

        lines = self.command_lines(ctx)
        names = [CompletionItem(name, help=line) for name, line in lines if name.startswith(incomplete)]
        return [*names, *click.Command.shell_complete(self, ctx, incomplete)]

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; Ctrl-C during its import, and errors of a plug-in, end the program without a traceback."""
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt:
            raise Exit(SIGINT_EXIT_CODE) from None
        except (Abort, Exit, OSError, click.ClickException):
            raise
        except Exception as error:
            plugin = self._plugins.get(ctx.invoked_subcommand or "")
            if plugin is None or sys.flags.dev_mode:
                raise
            raise _failure(plugin, error) from error

    @functools.cached_property
    def _plugins(self) -> dict[str, Plugin]:
        """The plug-ins by the names of their commands. They cannot replace coframe's own commands."""
        found = plugins(PLUGINS) if self._has_plugins else []
        return {plugin.name: plugin for plugin in found if plugin.name not in COMMANDS}

    def _load_own_command(self, name: str) -> click.Command:
        module = importlib.import_module(f"coframe.cli.{self._rows[name].module}")
        command: click.Command = getattr(module, name)
        command.short_help = self._rows[name].line
        return command


def _plugin_summary(plugin: Plugin) -> str:
    return f"Command of the package {plugin.package}."


def _load_command(plugin: Plugin) -> click.Command:
    try:
        command = plugin.load()
        if not isinstance(command, click.Command):
            raise plugin.error(f"is not a click command, but {command!r}")
    except PluginError as error:
        raise _Failure(f"{error}\n  {error.hint}") from error
    return command


def _failure(plugin: Plugin, error: Exception) -> _Failure:
    if isinstance(error, CoframeError):
        return _Failure(f"{error}\n  {error.hint}".rstrip())
    advice = f"Show the traceback with: python -X dev -m coframe.cli {plugin.name} ..."
    return _Failure(f"{plugin.error(f'has failed: {type(error).__name__}: {error}')}\n  {advice}")


class _Failure(click.ClickException):
    """An error in the format of coframe's own commands."""

    def show(self, file: Any = None) -> None:
        """Print the error on stderr."""
        click.echo(f"coframe: {self.format_message()}", err=True, file=file)


def _options() -> list[click.Parameter]:
    return [
        _action_option("--version", "Show the version and exit.", _print_version),
        _action_option("--install-completion", "Install completion for the current shell.", _install_completion),
        _action_option(
            "--show-completion",
            "Print the completion script for the current shell, to copy or customize it.",
            _show_completion,
        ),
        click.Option(
            ["--distro"],
            type=click.Choice(sorted(NAMES), case_sensitive=False),
            is_eager=True,
            expose_value=False,
            callback=_select_distribution,
            help="ROS 2 distribution to follow.  [default: COFRAME_DISTRO, ROS_DISTRO or jazzy]",
        ),
    ]


def _action_option(name: str, text: str, action: Any) -> click.Option:
    """Return an option that runs an action instead of a command."""

    def run(ctx: click.Context, _parameter: click.Parameter, requested: bool) -> None:
        if requested and not ctx.resilient_parsing:
            action(ctx)
            ctx.exit()

    return click.Option([name], is_flag=True, is_eager=True, expose_value=False, callback=run, help=text)


def _select_distribution(ctx: click.Context, _parameter: click.Parameter, name: str | None) -> None:
    if name and not ctx.resilient_parsing:
        os.environ["COFRAME_DISTRO"] = name
        current.cache_clear()


def _print_version(_ctx: click.Context) -> None:
    click.echo(f"coframe {coframe.__version__}")


def _install_completion(ctx: click.Context) -> None:
    from coframe.cli.shell_completion import install  # noqa: PLC0415 - rarely needed

    install(ctx)


def _show_completion(ctx: click.Context) -> None:
    from coframe.cli.shell_completion import script  # noqa: PLC0415 - rarely needed

    click.echo(script(ctx))
