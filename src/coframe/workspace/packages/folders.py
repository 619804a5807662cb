# SPDX-License-Identifier: Apache-2.0
"""Folders of ROS packages: a folder with a ``package.xml`` is a package, whose manifest has its name."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from coframe._files.bounded_xml import read_xml
from coframe._files.existence import is_dir, is_file

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["MANIFEST", "by_name", "crawl", "existing_folders", "package_around", "package_name"]

MANIFEST = "package.xml"
_SKIPPED_FOLDERS = {"build", "install", "log", "node_modules", "__pycache__"}


def existing_folders(variable: str) -> Iterator[Path]:
    """Return the existing folders in an environment variable."""
    entries = os.environ.get(variable, "").split(os.pathsep)
    return (Path(entry) for entry in entries if entry and is_dir(Path(entry)))


def package_around(path: Path) -> Path | None:
    """Return the innermost package that contains a file or folder, or is the folder, or None if there is none."""
    return next((folder for folder in [path, *path.parents] if is_file(folder / MANIFEST)), None)


def crawl(folder: Path, max_depth: int) -> Iterator[Path]:
    """Yield the packages at or below a folder. Packages inside packages are not searched."""
    if is_file(folder / MANIFEST):
        yield folder
        return
    if max_depth == 0:
        return
    try:
        inside = sorted(entry.name for entry in os.scandir(folder) if entry.is_dir(follow_symlinks=False))
    except OSError:  # no permission
        return
    for name in inside:
        if not name.startswith(".") and name not in _SKIPPED_FOLDERS:
            yield from crawl(folder / name, max_depth - 1)


def by_name(packages: list[Path]) -> dict[str, Path]:
    """Return packages by the name in their manifest, and also by the name of their folder."""
    found: dict[str, Path] = {}
    for package in packages:
        found.setdefault(package_name(package), package)
    for package in packages:  # the folder of an installed package can have another name
        found.setdefault(package.name, package)
    return found


def package_name(package: Path) -> str:
    """Return the name in the manifest of a package, or the name of its folder."""
    try:
        name = read_xml(package / MANIFEST).findtext("name") or ""
    except (OSError, ValueError):
        name = ""
    return name.strip() or package.name
