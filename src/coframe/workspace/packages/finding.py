# SPDX-License-Identifier: Apache-2.0
"""Find packages by name: installations in AMENT_PREFIX_PATH, then sources, then coframe's own packages."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe._files.existence import is_dir, is_file, resolved
from coframe._output.formatting import did_you_mean
from coframe.errors import PackageError
from coframe.workspace.packages import _builtin
from coframe.workspace.packages.folders import by_name, crawl, existing_folders, package_around, package_name
from coframe.workspace.packages.share_view import share_of_source

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = [
    "Package",
    "candidates",
    "find_package",
    "package_names",
    "source_folders",
    "source_roots",
    "use_sources_near",
]

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_\-]*", re.ASCII)
_SOURCES = "COFRAME_PACKAGE_PATH"
_INDEX = Path("share", "ament_index", "resource_index", "packages")
_MAX_DEPTH = 4  # levels of folders between a workspace and its packages
_MAX_NAMES = 12  # in an error message
_SEARCH_HINT = (
    "Packages are searched in a sourced workspace (AMENT_PREFIX_PATH), in COFRAME_PACKAGE_PATH, and in the workspace "
    "around the current folder and the launch file."
)


class Package(NamedTuple):
    """A found package.

    Attributes:
        name: The name of the package.
        share: Folder with its launch files and other data: ``share/NAME`` of an installation, or the source folder.
        prefix: Installation prefix; for a source folder, the folder that contains it.
        origin: ``"installed"``, ``"source"`` or ``"builtin"``.
        source: The source folder, or None if there is none.
    """

    name: str
    share: Path
    prefix: Path
    origin: str
    source: Path | None = None


def find_package(name: str) -> Package:
    """Return the package that comes first in the search order.

    Raises:
        PackageError: There is no such package; the hint lists similar names.
    """
    if not _NAME.fullmatch(name):
        raise PackageError(f"{name!r} is not a valid package name", hint="Use letters, digits, '_' and '-'.")
    package = next(candidates(name), None)
    if package is not None:
        return package
    known = package_names()
    guess = did_you_mean(name, known, limit=3)
    own = [each for each in known if each not in _builtin.names()]
    there = f"Packages: {', '.join(own[:_MAX_NAMES])}{', ...' if len(own) > _MAX_NAMES else ''}. " if own else ""
    raise PackageError(f"No package named {name!r}.", hint=f"{guess} {there}{_SEARCH_HINT}".lstrip())


def candidates(name: str) -> Iterator[Package]:
    """Yield all packages with this name in search order: an installed package hides its source, which may have more."""
    for prefix in existing_folders("AMENT_PREFIX_PATH"):
        if is_file(prefix / _INDEX / name) or is_file(prefix / "share" / name / "package.xml"):
            yield Package(name, prefix / "share" / name, prefix, "installed")
    for folder in source_roots():
        source = _packages_below(folder).get(name)
        if source is None and folder in existing_folders(_SOURCES) and is_dir(folder / name):
            source = folder / name  # A folder specified by the user may contain packages without a manifest.
        if source is not None:
            yield Package(name, share_of_source(source, name), source.parent, "source", source)
    if name in _builtin.names():
        yield Package(name, _builtin.share(name), _builtin.share(name).parent, "builtin")


def package_names() -> list[str]:
    """Return the names of all packages that can be found, sorted."""
    found = set(_builtin.names())
    for prefix in existing_folders("AMENT_PREFIX_PATH"):
        index = prefix / _INDEX
        found |= {marker.name for marker in index.iterdir()} if is_dir(index) else set()
    for folder in source_roots():
        found |= {package_name(package) for package in crawl(folder, _MAX_DEPTH)}
    return sorted(found)


def source_folders(path: Path) -> list[Path]:
    """Return the folders around a path that contain packages: the workspace's ``src``, or the package's neighbors."""
    package = package_around(path)
    start = path if package is None else package.parent
    sources = [folder for folder in [start, *start.parents] if folder.name == "src" and package_around(folder) is None]
    if sources:
        return [sources[-1]]
    found = [] if package is None else [package.parent]
    if package is None and is_dir(path / "src"):
        found.append(path / "src")
    elif package is None and any(True for _ in crawl(path, 1)):
        found.append(path)
    return found


def use_sources_near(*paths: Path) -> None:
    """Add the source folders around these paths to COFRAME_PACKAGE_PATH, for this process and its children."""
    known = [str(folder) for folder in existing_folders(_SOURCES)]
    found = [str(folder) for path in paths for folder in source_folders(resolved(path))]
    os.environ[_SOURCES] = os.pathsep.join(dict.fromkeys([*known, *found]))


def source_roots() -> list[Path]:
    """Return the folders that are searched for source folders of packages."""
    near = [Path.cwd()]
    if sys.argv and sys.argv[0].endswith(".py"):
        near.append(resolved(sys.argv[0]).parent)
    around = [folder for path in near for folder in source_folders(path)]
    return list(dict.fromkeys([*existing_folders(_SOURCES), *around]))


_crawled_folders: dict[Path, dict[str, Path]] = {}


def _packages_below(folder: Path) -> dict[str, Path]:
    if folder not in _crawled_folders:
        _crawled_folders[folder] = by_name(list(crawl(folder, _MAX_DEPTH)))
    return _crawled_folders[folder]
