# SPDX-License-Identifier: Apache-2.0
"""``coframe run``: runs an executable of a package, like ``ros2 run``."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from typing import TYPE_CHECKING

import click
from click.exceptions import Exit

from coframe.cli.declaration import PASS_ARGUMENTS_ON, Command, argument
from coframe.cli.output import fail
from coframe.errors import PackageError
from coframe.workspace.packages.executables import executables, find_executable
from coframe.workspace.packages.finding import find_package

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["run"]


# The arguments of the executable begin after its name, and may look like options.
@click.command(cls=Command, context_settings={**PASS_ARGUMENTS_ON, "allow_interspersed_args": False})
@click.pass_context
@argument("package", metavar="PACKAGE", help="Name of the package.")
@argument(
    "executable",
    metavar="[EXECUTABLE]",
    required=False,
    help="Name of the executable; omit it to list all executables.",
)
@click.option(
    "--prefix",
    metavar="COMMAND",
    default="",
    show_default=False,
    help="Run the executable with this command in front, e.g. 'gdb --args'.",
)
def run(
    context: click.Context,
    package: str,
    executable: str | None,
    prefix: str,
) -> None:
    """Run an executable of PACKAGE with the remaining arguments, like ros2 run.

    The package may be in a sourced workspace or in a source folder: console scripts of setup.py, setup.cfg and
    pyproject.toml run without colcon build. Put this command's options before PACKAGE.

    Example: coframe run my_package talker --ros-args -r chatter:=/news
    """
    try:
        if executable is None:
            find_package(package)
            click.echo("\n".join(sorted(executables(package))))
            return
        found = find_executable(package, executable)
    except PackageError as error:
        fail(str(error), error.hint)
    _replace_process([*shlex.split(prefix), *found.command, *context.args], found.environment())


def _replace_process(command: list[str], environment: Mapping[str, str]) -> None:
    """Replace this process with a command, so that only the command receives Ctrl-C and signals."""
    sys.stdout.flush()
    try:
        if os.name == "posix":
            os.execvpe(command[0], command, environment)  # noqa: S606 - the command is what the user asked for
        # Windows has no exec: Ctrl-C reaches both processes, and the child ends first.
        child = subprocess.Popen(command, env=environment)  # noqa: S603
    except OSError as error:
        fail(f"{command[0]} cannot be run: {error.strerror}")
    while True:
        try:
            raise Exit(child.wait())
        except KeyboardInterrupt:
            continue
