# SPDX-License-Identifier: Apache-2.0
"""Start Python processes that run modules of coframe.

``python -m MODULE`` puts the current folder first on `sys.path`: a file ``json.py`` or ``types.py`` in it would be
imported instead of the standard library's. The processes here do not import from the current folder.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["child_environment", "keep_alive_command", "pass_to_children", "python_command", "python_environment"]

_START_SCRIPT = str(Path(__file__).with_name("start.py"))
_KEEP_ALIVE_SCRIPT = str(Path(__file__).with_name("keep_alive.py"))
# Variables that would make a process without a terminal wait for input, or run a file at startup or exit.
_OMITTED_VARIABLES = ("PYTHONINSPECT", "PYTHONSTARTUP")
_PATH_VARIABLE = "PYTHONPATH"

# What this process passes on: variable -> (value, value in the environment of this process at that time).
_passed_variables: dict[str, tuple[str, str | None]] = {}


def pass_to_children(name: str, value: str) -> None:
    """Set an environment variable for child processes, but not for this process."""
    _passed_variables[name] = (value, os.environ.get(name))


def child_environment(base: Mapping[str, str] | None = None) -> dict[str, str]:
    """Return the environment for a child process, with the variables set by `pass_to_children`.

    Args:
        base: The base environment, or None for the environment of this process. A variable that was changed in it, for
        example
            by a launch file, keeps its value.
    """
    environment = dict(os.environ if base is None else base)
    for name, (value, before) in _passed_variables.items():
        if environment.get(name) == before:
            environment[name] = value
    return environment


def python_command(module: str, *arguments: str) -> list[str]:
    """Return the command that runs a module as ``python -m`` does, but without the current folder on its path.

    Start it with :func:`python_environment`.

    Args:
        module: The full name of a module of coframe.
        arguments: The arguments after it.
    """
    return [sys.executable, _START_SCRIPT, module, *arguments]


def keep_alive_command() -> list[str]:
    """Return the command of a process that does nothing until SIGINT, and is soon ready for it."""
    return [sys.executable, "-I", "-S", _KEEP_ALIVE_SCRIPT]


def python_environment(base: Mapping[str, str] | None = None) -> dict[str, str]:
    """Return the environment for a child process of Python.

    An empty element of PYTHONPATH, as in ``PYTHONPATH=/opt/packages:``, means the current folder, and is removed.
    Relative elements become absolute, so that they refer to the same folders in every process.

    Args:
        base: The base environment, or None for the environment of this process.
    """
    environment = child_environment(base)
    for name in _OMITTED_VARIABLES:
        environment.pop(name, None)
    if _PATH_VARIABLE in environment:
        elements = [
            str(Path(element).absolute()) for element in environment.pop(_PATH_VARIABLE).split(os.pathsep) if element
        ]
        if elements:
            environment[_PATH_VARIABLE] = os.pathsep.join(elements)
    return environment
