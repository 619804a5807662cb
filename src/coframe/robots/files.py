# SPDX-License-Identifier: Apache-2.0
"""Load robot descriptions from URDF and xacro files."""

from __future__ import annotations

import dataclasses
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe._files.regular_files import check_regular, read_regular, reading_hint
from coframe._process.optional_imports import pip_install
from coframe.errors import RobotDescriptionError
from coframe.robots._document import MAX_BYTES
from coframe.robots.urdf import parse_urdf
from coframe.robots.xacro_process import MAX_OUTPUT, MAX_SECONDS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from coframe.robots._robot import Robot

__all__ = ["expand_xacro", "load", "run_xacro"]

_PROCESS = Path(__file__).with_name("xacro_process.py")


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
        RobotDescriptionError: The file cannot be read or is not valid, see :func:`parse_urdf`. The message contains the
            file and the line.
    """
    file = Path(path)
    expands = file.suffix == ".xacro"
    try:
        text = expand_xacro(file, arguments, packages) if expands else read_regular(file, MAX_BYTES)
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise RobotDescriptionError(f"cannot be read: {reason}", file=str(file), hint=reading_hint(error)) from None
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
    *,
    run: Callable[[Sequence[str], bytes], subprocess.CompletedProcess[bytes]] | None = None,
) -> str:
    """Expand a xacro file and return the URDF.

    Args:
        path: The xacro file.
        arguments: The values of ``$(arg NAME)``.
        packages: Folders that ``$(find PACKAGE)`` searches first; see :class:`Packages`.
        run: Runs Python with some arguments and a standard input, and returns the standard output. None uses a child
            process with limits only on time and memory, which is not sufficient for untrusted files.

    Raises:
        RobotDescriptionError: xacro fails, or is not installed.
        OSError: The file cannot be read.
    """
    if importlib.util.find_spec("xacro") is None:
        reason = "the file is xacro, and the package xacro is not installed"
        raise RobotDescriptionError(reason, file=str(path), hint=pip_install("robots"))
    check_regular(path)
    answer = _expand(
        {
            "path": os.fspath(path),
            "arguments": dict(arguments or {}),
            "packages": [os.fspath(folder) for folder in packages],
            "module_folders": sys.path,
        },
        run or _run,
    )
    if "os_error" in answer:
        raise OSError(*answer["os_error"])
    if "text" not in answer:
        raise RobotDescriptionError(answer["error"], file=str(path), hint=answer.get("hint", ""))
    return str(answer["text"])


def _run(words: Sequence[str], request: bytes) -> subprocess.CompletedProcess[bytes]:
    command = [sys.executable, *words]
    return subprocess.run(command, input=request, capture_output=True, timeout=MAX_SECONDS, check=False)  # noqa: S603


def _expand(
    request: dict[str, Any], run: Callable[[Sequence[str], bytes], subprocess.CompletedProcess[bytes]]
) -> dict[str, Any]:
    """Expand a file in a separate process, because Python expressions in it can take any amount of time and memory."""
    try:
        result = run(("-I", str(_PROCESS)), json.dumps(request).encode())
    except subprocess.TimeoutExpired:
        return {"error": f"xacro: expanding the file takes longer than the maximum of {MAX_SECONDS:g} s"}
    try:
        answer: dict[str, Any] = json.loads(result.stdout)
    except ValueError:
        return {"error": f"xacro: the process that expands the file ended with exit code {result.returncode}"}
    return answer


def run_xacro(command: list[str], *, capture: bool = False) -> subprocess.CompletedProcess[str]:
    """Run the program xacro with limits on time, memory and output. On Windows, only time is limited.

    Args:
        command: The path of the program, and its arguments.
        capture: Whether standard error is captured as part of the output.

    Raises:
        RobotDescriptionError: The time or output limit was exceeded. If memory runs out, xacro itself fails.
    """
    limited = [sys.executable, "-I", str(_PROCESS)] if os.name == "posix" else []
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        try:
            result = subprocess.run(  # noqa: S603 - the caller's command
                [*limited, *command],
                stdout=output,
                stderr=subprocess.STDOUT if capture else errors,
                timeout=MAX_SECONDS,
                check=False,
            )
        except subprocess.TimeoutExpired:
            raise RobotDescriptionError(f"xacro takes longer than the maximum of {MAX_SECONDS:g} s") from None
        texts = []
        for file in (output, errors):
            if os.fstat(file.fileno()).st_size >= MAX_OUTPUT:
                raise RobotDescriptionError(f"the output of xacro is larger than the maximum of {MAX_OUTPUT >> 20} MiB")
            file.seek(0)
            texts.append(file.read().decode(errors="replace"))
    return subprocess.CompletedProcess(command, result.returncode, *texts)
