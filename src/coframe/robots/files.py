# SPDX-License-Identifier: Apache-2.0
"""Loading of robot descriptions from URDF and xacro files."""

from __future__ import annotations

import contextlib
import dataclasses
import io
import os
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe.errors import RobotDescriptionError
from coframe.robots.packages import Packages
from coframe.robots.urdf import parse_urdf

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from coframe.robots.robot import Robot

__all__ = ["expand_xacro", "load"]

_xacro_lock = threading.Lock()  # xacro keeps its state in module variables


def load(
    path: str | os.PathLike[str],
    *,
    arguments: Mapping[str, str] | None = None,
    packages: Iterable[str | os.PathLike[str]] = (),
) -> Robot:
    """Load a robot from a file.

    Args:
        path: A URDF file, or a ``.xacro`` file, which is expanded. Xacro files can contain Python expressions: load
            them only from trusted sources.
        arguments: The values of ``$(arg NAME)`` in xacro.
        packages: Folders that ``$(find PACKAGE)`` searches first; see :class:`Packages`.

    Raises:
        RobotDescriptionError: The file cannot be read or is not valid, see :func:`parse_urdf`. The text contains the
            file and the line.
    """
    file = Path(path)
    expands = file.suffix == ".xacro"
    try:
        text = expand_xacro(file, arguments, packages) if expands else file.read_bytes()
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise RobotDescriptionError(
            f"cannot be read: {reason}", file=str(file), hint="Check the path and the permissions of the file."
        ) from None
    try:
        robot = parse_urdf(text)
    except RobotDescriptionError as error:
        error.file = f"{file}, expanded" if expands else str(file)
        raise
    return dataclasses.replace(robot, path=file)


def expand_xacro(
    path: str | os.PathLike[str],
    arguments: Mapping[str, str] | None = None,
    packages: Iterable[str | os.PathLike[str]] = (),
) -> str:
    """Expand a xacro file and return the URDF.

    Args:
        path: The xacro file.
        arguments: The values of ``$(arg NAME)``.
        packages: Folders that ``$(find PACKAGE)`` searches first; see :class:`Packages`.

    Raises:
        RobotDescriptionError: xacro fails, or is not installed.
        OSError: The file cannot be read.
    """
    try:
        import xacro  # noqa: PLC0415 - optional dependency
    except ModuleNotFoundError:
        reason = "the file is xacro, and the package xacro is not installed"
        raise RobotDescriptionError(reason, file=str(path), hint="pip install 'coframe[robots]'") from None
    finder = Packages(path, packages)
    try:
        with _xacro_lock, _finding(finder), contextlib.redirect_stderr(io.StringIO()):
            document = xacro.process_file(os.fspath(path), mappings=dict(arguments or {}))
            return str(document.toprettyxml(indent="  "))
    except OSError:
        raise
    except Exception as error:  # noqa: BLE001 - Python expressions in the file can raise any exception
        reason = f"xacro: {str(error) or type(error).__name__}"
        raise RobotDescriptionError(reason, file=str(path), hint=getattr(error, "hint", "")) from None


@contextlib.contextmanager
def _finding(packages: Packages) -> Iterator[None]:
    """Resolve ``$(find PACKAGE)`` with `packages` instead of an installed ROS."""
    from xacro import substitution_args  # noqa: PLC0415

    previous: Any = substitution_args._eval_find  # noqa: SLF001 - xacro has no public hook for this
    substitution_args._eval_find = lambda name: str(packages.find(name))  # noqa: SLF001
    try:
        yield
    finally:
        substitution_args._eval_find = previous  # noqa: SLF001
