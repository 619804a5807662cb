# SPDX-License-Identifier: Apache-2.0
"""Substitution that evaluates to the output of a command."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import launch.logging
from coframe._process.optional_imports import pip_install
from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.find_executable import find_program
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

# xacro writes the file that contains the error, and advice, after the error.
_XACRO_ERROR = re.compile(r"error: |XML parsing error: |xacro\.XacroException: ")

__all__ = ["Command"]


@expose_substitution("command")
class Command(Substitution):
    """The standard output of a command, such as ``Command(["xacro ", path])``.

    Args:
        command: The command line.
        on_stderr: What to do if the command writes to standard error: ``fail``, ``ignore``, ``warn`` or ``capture``.
    """

    def __init__(self, command: SomeSubstitutionsType, *, on_stderr: SomeSubstitutionsType = "fail") -> None:
        self.__command = normalize_to_list_of_substitutions(command)
        self.__on_stderr = normalize_to_list_of_substitutions(on_stderr)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(command COMMAND [ON_STDERR])``."""
        check_arguments("command", data, 1, 2)
        return cls, {"command": data[0]} | ({"on_stderr": data[1]} if len(data) == 2 else {})

    @property
    def command(self) -> list[Substitution]:
        """The command line."""
        return self.__command

    @property
    def on_stderr(self) -> list[Substitution]:
        """What to do if the command writes to standard error."""
        return self.__on_stderr

    def describe(self) -> str:
        """Return a one-line description."""
        return f"Command({' + '.join(part.describe() for part in self.command)})"

    def perform(self, context: LaunchContext) -> str:
        """Run the command and return its output.

        Raises:
            SubstitutionFailure: The command does not exist, or has failed.
        """
        text = perform_substitutions(context, self.__command)
        words = shlex.split(text, posix=os.name == "posix")
        on_stderr = perform_substitutions(context, self.__on_stderr)
        if on_stderr not in {"fail", "ignore", "warn", "capture"}:
            raise SubstitutionFailure(f"Command: on_stderr must be fail, ignore, warn or capture, not {on_stderr!r}")
        if not words:
            raise SubstitutionFailure("Command: the command line is empty")
        program = find_program(words[0])
        if program is None:
            raise SubstitutionFailure(_missing_program_error(words[0], text))
        result = _run([program, *words[1:]], capture=on_stderr == "capture")
        stderr = result.stderr or ""
        if result.returncode != 0:
            cause = _cause(stderr)
            message = f"{f'{cause}: ' if cause else ''}executed command failed. Command: {text}"
            raise SubstitutionFailure(f"{message}\nCaptured stderr output: {stderr}" if stderr else message)
        if stderr and on_stderr == "fail":
            raise SubstitutionFailure(
                f"executed command showed stderr output. Command: {text}\nCaptured stderr output:\n{stderr}"
            )
        if stderr and on_stderr == "warn":
            launch.logging.get_logger("launch").warning(
                f"executed command showed stderr output. Command: {text}\nCaptured stderr output:\n{stderr}"
            )
        return result.stdout


def _cause(stderr: str) -> str:
    """Return the line that states why a command failed: xacro's error, or the last line, as after a traceback."""
    lines = [line.strip() for line in stderr.splitlines() if line.strip()]
    return next(filter(_XACRO_ERROR.match, lines), lines[-1] if lines else "")


def _run(command: list[str], *, capture: bool) -> subprocess.CompletedProcess[str]:
    """Run a command; expressions in a xacro file can take unlimited time and memory, so xacro runs with limits."""
    if PurePath(command[0]).stem == "xacro":
        from coframe.errors import RobotDescriptionError  # noqa: PLC0415 - few launch files need it
        from coframe.robots.files import run_xacro  # noqa: PLC0415

        try:
            return run_xacro(command, capture=capture)
        except RobotDescriptionError as error:
            raise SubstitutionFailure(f"{error} Command: {shlex.join(command)}") from None
    return subprocess.run(  # noqa: S603 - the launch file names the command
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT if capture else subprocess.PIPE,
        encoding="utf-8",  # that of robot descriptions; the system's may differ
        errors="replace",
        check=False,
    )


def _missing_program_error(program: str, text: str) -> str:
    hint = f" Install it: {pip_install('robots')}" if PurePath(program).name == "xacro" else ""
    return f"executable '{program}' not found on the PATH.{hint} Command: {text}"
