# SPDX-License-Identifier: Apache-2.0
"""The substitution with the path of an executable in a package."""

from __future__ import annotations

import os
import shlex
from typing import TYPE_CHECKING, Any

from coframe._output.formatting import error_text
from coframe.errors import PackageError
from coframe.workspace.packages.executables import Executable, find_executable
from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.temporary_files import write_temporary_file

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["ExecutableInPackage", "executable_in_package"]


@expose_substitution("exec-in-pkg")
@expose_substitution("exec-in-package")
class ExecutableInPackage(Substitution):
    """The path of an executable of a package. For a console script that is not installed, the path of a wrapper."""

    def __init__(self, executable: SomeSubstitutionsType, package: SomeSubstitutionsType) -> None:
        self.__executable = normalize_to_list_of_substitutions(executable)
        self.__package = normalize_to_list_of_substitutions(package)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(exec-in-pkg EXECUTABLE PACKAGE)``."""
        check_arguments("exec-in-pkg", data, 2, 2)
        return cls, {"executable": data[0], "package": data[1]}

    @property
    def executable(self) -> list[Substitution]:
        """The name of the executable."""
        return self.__executable

    @property
    def package(self) -> list[Substitution]:
        """The name of the package."""
        return self.__package

    def describe(self) -> str:
        """Return a one-line description."""
        package, executable = (
            " + ".join(part.describe() for part in parts) for parts in (self.package, self.executable)
        )
        return f"ExecInPkg(pkg={package}, exec={executable})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        package = perform_substitutions(context, self.__package)
        found = executable_in_package(package, perform_substitutions(context, self.__executable))
        return found.command[0] if len(found.command) == 1 else _wrapper(found)


def executable_in_package(package: str, name: str) -> Executable:
    """Return an executable of a package.

    Raises:
        SubstitutionFailure: There is no such package or executable; the text lists similar names.
    """
    try:
        return find_executable(package, name)
    except PackageError as error:
        raise SubstitutionFailure(error_text(error)) from None


def _wrapper(executable: Executable) -> str:
    """Write a program that runs the command of an executable, and return its path."""
    if os.name != "posix":
        path = os.pathsep.join(executable.python_path)
        command = " ".join(f'"{word}"' for word in executable.command)
        return str(write_temporary_file(f'@set "PYTHONPATH={path};%PYTHONPATH%"\r\n@{command} %*\r\n', ".bat"))
    path = shlex.quote(os.pathsep.join(executable.python_path))
    setting = f"PYTHONPATH={path}${{PYTHONPATH:+:$PYTHONPATH}} " if executable.python_path else ""
    file = write_temporary_file(f'#!/bin/sh\n{setting}exec {shlex.join(executable.command)} "$@"\n', ".sh")
    file.chmod(0o755)
    return str(file)
