# SPDX-License-Identifier: Apache-2.0
"""Locate the parts of coframe that contain solutions of the lab, and detect which of them a program opens."""

from __future__ import annotations

import contextlib
import glob
import os
import struct
import sys
from importlib.util import cache_from_source
from pathlib import Path
from typing import TYPE_CHECKING, Final

import coframe
from coframe._process.graded_programs import SOLUTIONS, refusal
from coframe.course.sandbox.kernel import c_function

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Decoys", "entry_files", "solution_folders", "solution_problem"]

# Package folders of other Python installations, in which coframe may also be installed.
_OTHER_PACKAGES: Final = (
    "/usr/lib*/python3*",
    "/usr/local/lib*/python3*",
    "/opt/*/lib*/python3*",
    "/opt/*/*/*/lib*/python3*",
)
# sys/inotify.h
_NON_BLOCKING, _CLOSE_ON_EXEC, _OPENED, _IS_FOLDER = 0o4000, 0o2000000, 0x20, 0x40000000
_EVENT: Final = struct.Struct("iIII")
_BUFFER = 1 << 16


def solution_folders() -> list[str]:
    """Return all folders with solutions, including other installations, and the locations of their compiled files."""
    packages = {*coframe.__path__, *(os.path.join(path, "coframe") for path in sys.path)}  # noqa: PTH118
    for pattern in _OTHER_PACKAGES:
        packages |= {*glob.glob(f"{pattern}/*-packages/coframe")}  # noqa: PTH207 - patterns for absolute paths
    folders = [Path(package, part.rpartition(".")[2]) for package in packages for part in SOLUTIONS]
    found = {os.path.realpath(folder) for folder in folders if folder.is_dir()}
    if sys.pycache_prefix is not None:
        found |= {str(Path(cache_from_source(f"{folder}/x.py")).parent) for folder in found}
    return sorted(found)


def entry_files(folders: list[str]) -> list[str]:
    """Return the readable files in these folders. They contain no solutions, and raise an error on import."""
    return [file for folder in folders if os.path.isfile(file := f"{folder}/__init__.py")]  # noqa: PTH113


def solution_problem(name: str) -> str:
    """Return the message in a report about a program that uses one of these packages.

    Args:
        name: The package, or one of its files, such as "coframe.lab/tf_listener.py".
    """
    package, _, file = name.partition("/")
    files = f"its file {file}" if file else "its files"
    return f"The program imports {package}, which contains solutions, or reads {files}. The program gets no points."


class Decoys:
    """Folders that programs find instead of those with solutions: the same file names without their contents.

    The kernel reports when one of these files is opened, regardless of how the program found it.

    Attributes:
        folders: The decoy of each folder.
    """

    def __init__(self, place: Path) -> None:
        """Create the folders.

        Args:
            place: An empty folder, or one that does not exist.
        """
        self.folders: dict[str, str] = {}
        self._watched_folders: dict[int, str] = {}
        self._events: int | None = None
        # The limit per user may be reached. Imports are then still reported by their exception.
        with contextlib.suppress(OSError):
            self._events = c_function("inotify_init1", _NON_BLOCKING | _CLOSE_ON_EXEC)
        for number, folder in enumerate(solution_folders()):
            decoy = place / str(number)
            self.folders[folder] = str(decoy)
            self._copy(Path(folder), decoy)

    def close(self) -> None:
        """Stop watching."""
        if self._events is not None:
            os.close(self._events)

    def opened(self) -> str:
        """Return the first file opened since the last call, such as "coframe.lab/tf_listener.py", or "" if none was."""
        found = ""
        for number, flags, name in self._read():
            if not flags & _IS_FOLDER:
                found = found or f"{self._watched_folders.get(number, SOLUTIONS[0])}/{name}"
        return found

    def _read(self) -> Iterator[tuple[int, int, str]]:
        while self._events is not None:
            try:
                content = os.read(self._events, _BUFFER)
            except BlockingIOError:
                return
            offset = 0
            while offset < len(content):
                number, flags, _, length = _EVENT.unpack_from(content, offset)
                offset += _EVENT.size + length
                yield number, flags, os.fsdecode(content[offset - length : offset].rstrip(b"\0"))

    def _copy(self, source: Path, target: Path) -> None:
        package = f"coframe.{source.name}"
        for path, folders, files in os.walk(source):
            folder = target / Path(path).relative_to(source)
            folder.mkdir(parents=True)
            folders[:] = [name for name in folders if name != "__pycache__"]
            for name in files:
                (folder / name).write_text(f"raise ImportError({refusal(package)!r})\n", encoding="utf-8")
            if self._events is not None:
                with contextlib.suppress(OSError):
                    number = c_function("inotify_add_watch", self._events, os.fsencode(folder), _OPENED)
                    self._watched_folders[number] = package
