# SPDX-License-Identifier: Apache-2.0
"""``coframe ros2``: adds the executables ``ros2``, ``rviz2`` and ``launch_test`` to the environment, and removes them.

They are not installed with the package, because pip overwrites files with the same names: in a conda environment with
ROS (RoboStack), the real ones are in the same folder.
"""

from __future__ import annotations

import contextlib
import importlib.metadata
import os
import site
import sysconfig
from pathlib import Path
from typing import TYPE_CHECKING

from coframe._process.python_children import python_command
from coframe.cli.declaration import CommandGroup
from coframe.cli.output import fail, printable
from coframe.cli.ros2.executable import is_own_script, real_executable

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["ros2"]

_NAMES = ("ros2", "rviz2", "launch_test")
ros2 = CommandGroup(
    "ros2",
    help="Add the executables of ROS 2 if no ROS is installed.\n\nExample: coframe ros2 install",
)


@ros2.command(short_help="Add the executables ros2, rviz2 and launch_test.")
def install() -> None:
    """Add the executables ros2, rviz2 and launch_test to this Python environment.

    Executables of a real ROS are not replaced. The new ones run coframe's commands. pip uninstall coframe also removes
    them.

    Example: coframe ros2 install
    """
    for name, path in _scripts():
        real = real_executable(name)
        if real is not None:
            print(f"{name}: {printable(str(real))} already exists and is not replaced")
            continue
        try:
            path.write_text(_script(name), encoding="utf-8")
            path.chmod(0o755)
        except OSError as error:
            fail(f"cannot write {path}: {error.strerror}", "Use a virtual environment: python -m venv .venv")
        _add_to_record(path)
        print(f"created {printable(str(path))}")


@ros2.command(short_help="Remove the executables that coframe added.")
def remove() -> None:
    """Remove the executables ros2, rviz2 and launch_test added by coframe ros2 install.

    Example: coframe ros2 remove
    """
    for _, path in _scripts():
        if path.is_file() and is_own_script(path):
            path.unlink()
            print(f"removed {printable(str(path))}")


def _scripts() -> Iterator[tuple[str, Path]]:
    """Yield the name and the path of each executable."""
    folder = _folder()
    for name in _NAMES:
        yield name, folder / (f"{name}.cmd" if os.name == "nt" else name)


def _folder() -> Path:
    """Return the folder of the executables of this installation, which may be the user's own (`pip install --user`)."""
    if Path(__file__).is_relative_to(site.getusersitepackages()):
        return Path(sysconfig.get_path("scripts", sysconfig.get_preferred_scheme("user")))
    return Path(sysconfig.get_path("scripts"))


def _script(name: str) -> str:
    """Return the text of an executable. The path of Python may contain spaces and may be long."""
    words = python_command("coframe.workspace.entry_point", f"coframe.cli.ros2.executable:{name}")
    command = " ".join(f'"{word}"' for word in words)
    return f"@{command} %*\n" if os.name == "nt" else f'#!/bin/sh\nexec {command} "$@"\n'


def _add_to_record(path: Path) -> None:
    """Add an executable to the files of the installed package, so that uninstalling removes it."""
    with contextlib.suppress(importlib.metadata.PackageNotFoundError, OSError):
        package = importlib.metadata.distribution("coframe")
        records = [Path(str(package.locate_file(file))) for file in package.files or () if file.name == "RECORD"]
        for record in records:
            line = f"{Path(os.path.relpath(path, record.parent.parent)).as_posix()},,"
            text = record.read_text(encoding="utf-8")
            if line not in text.splitlines():
                record.write_text(text.rstrip("\n") + f"\n{line}\n", encoding="utf-8")
