# SPDX-License-Identifier: Apache-2.0
"""The workspace around a script: the folder that contains the packages it belongs to."""

from __future__ import annotations

import contextlib
import os
import sys
from itertools import islice
from pathlib import Path

from coframe.existence import exists, is_file

__all__ = ["start_folders", "workspace_root"]

_MOST_LEVELS = 12
_MOST_ENTRIES = 200


def start_folders() -> list[Path]:
    """Return the folder of the running script and the current directory."""
    folders: list[Path] = []
    script = getattr(sys.modules.get("__main__"), "__file__", None)
    if script and not Path(script).absolute().is_relative_to(sys.prefix):  # A command such as pytest is not the script.
        folders.append(Path(script).absolute().parent)
    with contextlib.suppress(OSError):  # The current directory may have been deleted.
        folders.append(Path.cwd())
    return list(dict.fromkeys(folders))


def workspace_root(start: Path) -> Path | None:
    """Return the folder of the workspace in which packages are searched; None outside a workspace.

    This is the outermost ``src`` folder with packages above or next to the start; without one, the outermost folder
    above the start that is a package or a Git repository. The home directory and the root directory are not searched.
    """
    src: Path | None = None
    project: Path | None = None
    home = Path(os.path.expanduser("~"))  # noqa: PTH111 - Path.home() fails where there is no home directory
    for folder in [start, *start.parents][:_MOST_LEVELS]:
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
    """Return whether one of the first entries of a folder, or of a folder in it, is a package."""
    children = _first_folders(folder)
    return any(
        is_file(path / "package.xml")
        for child in children
        for path in (child, *(_first_folders(child) if not is_file(child / "package.xml") else ()))
    )


def _first_folders(folder: Path) -> list[Path]:
    try:
        return [path for path in islice(folder.iterdir(), _MOST_ENTRIES) if path.is_dir()]
    except OSError:
        return []
