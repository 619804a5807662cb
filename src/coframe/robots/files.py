"""Robot descriptions from files: URDF, and xacro that becomes URDF."""

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

_one_at_a_time = threading.Lock()  # xacro keeps what it does in its module


def load(
    path: str | os.PathLike[str],
    *,
    arguments: Mapping[str, str] | None = None,
    packages: Iterable[str | os.PathLike[str]] = (),
) -> Robot:
    """A robot from a file.

    Args:
        path: A ``.xacro`` file, which is expanded (with Python expressions in it: take it from those you trust), or
            URDF.
        arguments: What ``$(arg NAME)`` gives in xacro.
        packages: Folders in which ``$(find PACKAGE)`` looks first; see :class:`Packages`.

    Raises:
        RobotDescriptionError: The file is not there, or as of :func:`parse_urdf`; the text names file and line.
    """
    file = Path(path)
    expands = file.suffix == ".xacro"
    try:
        text = expand_xacro(file, arguments, packages) if expands else file.read_bytes()
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise RobotDescriptionError(
            f"cannot be read: {reason}", file=str(file), hint="Check the path, and who may read it."
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
    """The URDF that a xacro file expands to.

    Raises:
        RobotDescriptionError: xacro refuses it, or is not installed.
    """
    try:
        import xacro  # noqa: PLC0415 - an extra
    except ModuleNotFoundError:
        reason = "this is xacro, and the package xacro is not installed"
        raise RobotDescriptionError(reason, file=str(path), hint="pip install 'coframe[robots]'") from None
    finder = Packages(path, packages)
    try:
        with _one_at_a_time, _finding(finder), contextlib.redirect_stderr(io.StringIO()):
            document = xacro.process_file(os.fspath(path), mappings=dict(arguments or {}))
            return str(document.toprettyxml(indent="  "))
    except OSError:
        raise
    except Exception as error:  # noqa: BLE001 - xacro runs the file's own Python expressions
        reason = f"xacro: {str(error) or type(error).__name__}"
        raise RobotDescriptionError(reason, file=str(path), hint=getattr(error, "hint", "")) from None


@contextlib.contextmanager
def _finding(packages: Packages) -> Iterator[None]:
    """Makes ``$(find PACKAGE)`` ask us instead of an installed ROS."""
    from xacro import substitution_args  # noqa: PLC0415

    previous: Any = substitution_args._eval_find  # noqa: SLF001 - there is no other way in
    substitution_args._eval_find = lambda name: str(packages.find(name))  # noqa: SLF001
    try:
        yield
    finally:
        substitution_args._eval_find = previous  # noqa: SLF001
