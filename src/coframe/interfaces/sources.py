# SPDX-License-Identifier: Apache-2.0
"""The folders in which users' interface packages are found.

In this order: the paths in ``COFRAME_INTERFACES``, the paths added with ``coframe interface add``, the folder of the
program and its workspace, the source folders of ``coframe run`` and ``coframe launch`` (``COFRAME_PACKAGE_PATH``),
the prefixes of a sourced ROS workspace (``AMENT_PREFIX_PATH``), and installed distributions with an entry point in the
group ``coframe.messages``. With -I, -P or PYTHONSAFEPATH, only in the last ones.
"""

from __future__ import annotations

import functools
import os
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe.interfaces._installed import installed_packages
from coframe.interfaces.definition_files import has_definitions, is_own_package, package_name
from coframe.interfaces.user_folders import added_paths
from coframe.interfaces.workspace import is_search_disabled, start_folders, workspace_root

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

__all__ = ["ENVIRONMENT", "InterfaceFolder", "find_folder", "forget", "package_folders", "sources"]

ENVIRONMENT = "COFRAME_INTERFACES"
_PREFIXES = "AMENT_PREFIX_PATH"
_PACKAGE_PATH = "COFRAME_PACKAGE_PATH"
_MAX_FOLDERS = 5_000  # per source; a search must end even if a link or a mistyped path leads to a whole disk
_MAX_DEPTH = 8
_SKIPPED_FOLDERS = {
    "build",
    "install",
    "log",
    "node_modules",
    "__pycache__",
    "venv",
    "site-packages",
    "msg",
    "srv",
    "action",
}
_IGNORE_MARKERS = {"COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"}

_indexes: dict[tuple[Path, int], dict[str, Path]] = {}


class InterfaceFolder(NamedTuple):
    """A folder in which packages are searched.

    Attributes:
        origin: Why it is searched, for messages.
        folder: The path of the folder.
        depth: How many levels below the folder packages are searched.
        named: Whether the user specified it, in which case it may belong to another user.
        package: The name of the package in the folder; "": the folder contains packages.
    """

    origin: str
    folder: Path
    depth: int
    named: bool = True
    package: str = ""


def sources() -> list[InterfaceFolder]:
    """Return all folders in which packages are searched, in order."""
    if is_search_disabled():
        return _installed_folders()
    variables = tuple(os.environ.get(name, "") for name in (ENVIRONMENT, _PACKAGE_PATH, _PREFIXES))
    return [*_sources(tuple(start_folders()), *variables), *_installed_folders()]


def _installed_folders() -> list[InterfaceFolder]:
    return [
        InterfaceFolder(f"installed package {each.distribution}", each.folder, 0, package=each.name)
        for each in installed_packages()
    ]


@functools.lru_cache(maxsize=16)
def _sources(starts: tuple[Path, ...], given: str, package_path: str, prefixes: str) -> list[InterfaceFolder]:
    found = [InterfaceFolder(ENVIRONMENT, path, _MAX_DEPTH) for path in _paths(given)]
    found += [InterfaceFolder("coframe interface add", path, _MAX_DEPTH) for path in added_paths()]
    for start in starts:
        found.append(InterfaceFolder("folder of the program", start, 1, named=False))
        root = workspace_root(start)
        if root is not None:
            found.append(InterfaceFolder("workspace", root, _MAX_DEPTH, named=False))
    found += [InterfaceFolder(_PACKAGE_PATH, path, _MAX_DEPTH, named=False) for path in _paths(package_path)]
    found += [InterfaceFolder(_PREFIXES, path / "share", 1) for path in _paths(prefixes)]
    first: dict[tuple[Path, int], InterfaceFolder] = {}
    for source in found:
        first.setdefault((source.folder, source.depth), source)
    return list(first.values())


def find_folder(package: str) -> Path | None:
    """Return the folder of a user's interface package, or None if there is none."""
    for source in sources():
        if source.package:
            if source.package == package:
                return source.folder
            continue
        if source.origin == _PREFIXES:
            folder = source.folder / package  # An installation names folders after packages, and can contain thousands.
            if has_definitions(folder):
                return folder
            continue
        folder_of = _index(source).get(package)
        if folder_of is not None:
            return folder_of
    return None


def package_folders(source: InterfaceFolder) -> dict[str, Path]:
    """Return the folder of each interface package in a source, by its name."""
    return dict(_index(source))


def forget() -> None:
    """Clear the cache, because files or settings may have changed."""
    _indexes.clear()
    _sources.cache_clear()


def _paths(text: str) -> list[Path]:
    return [Path(path).absolute() for path in text.split(os.pathsep) if path]


def _index(source: InterfaceFolder) -> dict[str, Path]:
    if source.package:
        return {source.package: source.folder}
    key = (source.folder, source.depth)
    if key not in _indexes:
        index: dict[str, Path] = {}
        for folder in _package_candidates(source.folder, source.depth):
            usable = has_definitions(folder) and (source.named or is_own_package(folder))
            name = package_name(folder) if usable else None
            if name is not None:
                index.setdefault(name, folder)
        _indexes[key] = index
    return _indexes[key]


def _package_candidates(root: Path, depth: int) -> Iterator[Path]:
    """Yield folders that may be packages, level by level. The folders inside a package are not searched."""
    level, left = [root], _MAX_FOLDERS
    for _ in range(depth + 1):
        below: list[Path] = []
        for folder in level:
            left -= 1
            if left < 0:
                return
            entries = _entries(folder)
            names = {entry.name for entry in entries}
            if names & _IGNORE_MARKERS:
                continue
            if "package.xml" in names or names & {"msg", "srv", "action"}:
                yield folder
            if "package.xml" not in names:
                below += _folders(entries)
        level = below


def _entries(folder: Path) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as entries:
            return sorted(entries, key=lambda entry: entry.name)
    except OSError:
        return []


def _folders(entries: Iterable[os.DirEntry[str]]) -> list[Path]:
    return [Path(entry.path) for entry in entries if _is_searched(entry)]


def _is_searched(entry: os.DirEntry[str]) -> bool:
    if entry.name in _SKIPPED_FOLDERS or entry.name.startswith("."):
        return False
    try:
        return entry.is_dir()
    except OSError:
        return False
