# SPDX-License-Identifier: Apache-2.0
"""Files and folders that coframe stores for the user: added interface packages, and stubs for editors."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from coframe._files.complete_files import write_complete
from coframe._files.existence import exists
from coframe._files.regular_files import read_regular
from coframe.interfaces.problems import report

MAX_BYTES = 1 << 20  # of the settings file

__all__ = ["added_paths", "set_added_paths", "settings_file", "stub_folder"]


def settings_file() -> Path:
    """Return the file with the paths added by ``coframe interface add``, one per line."""
    return _folder("XDG_CONFIG_HOME", "APPDATA", ".config", "Library/Application Support") / "interfaces.txt"


def stub_folder() -> Path:
    """Return the folder with stubs of users' interface packages, for editor settings."""
    return _folder("XDG_CACHE_HOME", "LOCALAPPDATA", ".cache", "Library/Caches") / "stubs"


def added_paths() -> list[Path]:
    """Return the paths that the user added; report lines that are not paths, for example after a power loss."""
    file = settings_file()
    if not exists(file):
        return []
    try:
        lines = os.fsdecode(read_regular(file, MAX_BYTES)).splitlines()
    except OSError as error:
        report(f"{file} is skipped: {error.strerror}")
        return []
    damaged = [line for line in lines if "\0" in line]
    if damaged:
        report(f"{file} is damaged: {len(damaged)} of its lines are skipped. Run: coframe interface add FOLDER")
    return [Path(line) for line in lines if line.strip() and line not in damaged]


def set_added_paths(paths: list[Path]) -> None:
    """Save the paths that the user added."""
    file = settings_file()
    file.parent.mkdir(parents=True, exist_ok=True)
    write_complete(file, "".join(f"{path}\n" for path in paths).encode("utf-8", "surrogateescape"))


def _folder(xdg: str, windows: str, linux: str, macos: str) -> Path:
    given = os.environ.get(xdg) or (os.environ.get(windows) if sys.platform == "win32" else None)
    if given:
        return Path(given) / "coframe"
    below = macos if sys.platform == "darwin" else linux
    return Path(os.path.expanduser("~")) / below / "coframe"  # noqa: PTH111 - Path.home() can fail
