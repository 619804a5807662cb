# SPDX-License-Identifier: Apache-2.0
"""What a student's program may read: the system, Python with its packages, ROS, and its own folder."""

from __future__ import annotations

import os
import sys
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

from coframe.existence import exists

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["readable_paths"]

# Folders of the system, and those in which package managers install.
_SYSTEM: Final = (
    *("/bin", "/dev", "/etc", "/lib", "/lib32", "/lib64", "/opt", "/proc", "/sbin", "/sys", "/usr"),
    *("/gnu/store", "/home/linuxbrew", "/nix/store", "/snap"),
)
# Variables with folders of packages and libraries, of a sourced ROS 2 and others.
_VARIABLES: Final = ("AMENT_PREFIX_PATH", "LD_LIBRARY_PATH", "PATH", "PYTHONPATH", "VIRTUAL_ENV")
_DDS_CONFIGURATION: Final = "CYCLONEDDS_URI"
_MAPPED = Path("/proc/self/maps")


def readable_paths(folder: Path) -> list[str]:
    """Return the folders and files that a program may read.

    Args:
        folder: The folder of the program.
    """
    return sorted({str(folder.resolve()), *_shared_paths()})


@cache
def _shared_paths() -> frozenset[str]:
    """Return what the programs of all students may read, without the folders that contain others' files."""
    found = {os.path.realpath(path) for path in _candidates() if path.is_absolute()}
    kept_private = {os.path.realpath(path) for path in ("/", "/home", "/root", "/tmp", Path.home())}  # noqa: S108
    return frozenset(path for path in found - kept_private if exists(Path(path)))


def _candidates() -> Iterator[Path]:
    yield from map(Path, (*_SYSTEM, sys.prefix, sys.base_prefix, sys.exec_prefix, *sys.path))
    for name in _VARIABLES:
        yield from map(Path, os.environ.get(name, "").split(os.pathsep))
    yield Path(os.environ.get(_DDS_CONFIGURATION, "").removeprefix("file://"))
    # What the grader itself has loaded: the same packages and libraries.
    for module in tuple(sys.modules.values()):
        yield Path(getattr(module, "__file__", None) or "").parent
    if _MAPPED.is_file():
        for line in _MAPPED.read_text(errors="replace").splitlines():
            yield Path("/" + line.partition("/")[2]).parent
