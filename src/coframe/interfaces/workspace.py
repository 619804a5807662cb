# SPDX-License-Identifier: Apache-2.0
"""The workspace around a program: the folder that contains the packages it belongs to."""

from __future__ import annotations

import contextlib
import os
import sys
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from coframe._files.existence import exists, is_file

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["add_start_folder", "is_search_disabled", "start_folders", "workspace_root"]

_MAX_LEVELS = 12
_MAX_ENTRIES = 200
# Folders with programs and libraries of an environment, below its prefix and, on Debian, below `local`.
_INSTALLATION_FOLDERS = ("bin", "Scripts", "lib", "lib64", "libexec", "Lib")


_added_folders: list[Path] = []


def add_start_folder(folder: Path) -> None:
    """Add a folder in which the search starts, as if a program in it were running."""
    _added_folders.append(folder.absolute())


def is_search_disabled() -> bool:
    """Return whether -I, -P or PYTHONSAFEPATH prevent Python from importing from the folder of the program."""
    if sys.flags.isolated or getattr(sys.flags, "safe_path", False):
        return True
    # Python 3.10 does not support the variable.
    return sys.version_info < (3, 11) and not sys.flags.ignore_environment and bool(os.environ.get("PYTHONSAFEPATH"))


def start_folders() -> list[Path]:
    """Return the folders from which Python imports the program: the script's folder, or a session's current folder.

    Installed commands such as pytest do not import from the current folder, so they have none.
    """
    return list(
        dict.fromkeys([*_added_folders, *(folder for folder in _program_folders() if not _is_installed(folder))])
    )


def _program_folders() -> Iterator[Path]:
    script = getattr(sys.modules.get("__main__"), "__file__", None)
    if script:
        yield Path(script).absolute().parent
    with contextlib.suppress(OSError):  # The current folder may have been deleted.
        if sys.path and sys.path[0]:
            yield Path(sys.path[0]).absolute()
        if "" in sys.path:
            yield Path.cwd()


def _is_installed(folder: Path) -> bool:
    for prefix in (sys.prefix, sys.base_prefix, os.path.expanduser("~/.local")):  # noqa: PTH111 - as in workspace_root
        if folder.is_relative_to(prefix):
            first = [part for part in folder.relative_to(prefix).parts if part != "local"][:1]
            if first and first[0] in _INSTALLATION_FOLDERS:
                return True
    return False


def workspace_root(start: Path) -> Path | None:
    """Return the folder of the workspace in which packages are searched, or None outside a workspace.

    This is the outermost ``src`` folder with packages above or next to the start; without one, the outermost folder
    above the start that is a package or a Git repository. The home directory and the root directory are not searched.
    """
    src: Path | None = None
    project: Path | None = None
    home = Path(os.path.expanduser("~"))  # noqa: PTH111 - Path.home() fails where there is no home directory
    for folder in [start, *start.parents][:_MAX_LEVELS]:
        if folder in {home, Path(folder.anchor)}:
            break
        if folder.name == "src" and _has_packages(folder):
            src = folder
        elif _has_packages(folder / "src"):
            src = folder / "src"
        elif is_file(folder / "package.xml") or exists(folder / ".git"):
            project = folder
    return src or project


def _has_packages(folder: Path) -> bool:
    """Return whether one of the first entries of a folder or its subfolders is a package."""
    children = _first_folders(folder)
    return any(
        is_file(path / "package.xml")
        for child in children
        for path in (child, *(_first_folders(child) if not is_file(child / "package.xml") else ()))
    )


def _first_folders(folder: Path) -> list[Path]:
    try:
        return [path for path in islice(folder.iterdir(), _MAX_ENTRIES) if path.is_dir()]
    except OSError:
        return []
