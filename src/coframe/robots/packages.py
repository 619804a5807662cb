"""Where packages are, with and without ROS, and the files that ``package://`` names."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import unquote
from xml.etree import ElementTree as ET

from coframe.errors import PackageError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

__all__ = ["Packages"]

_MANIFEST = "package.xml"
_DEEPEST = 4  # folders between a workspace and its packages
_NEIGHBOURS = 2  # the folder around a package may hold anything, such as all of somebody's home
_NOT_SEARCHED = {"build", "install", "log", "node_modules", "__pycache__"}


class Packages:
    """Finds packages by name.

    In this order: the package around ``near`` and its neighbours, ``folders``, those of COFRAME_PACKAGE_PATH, the
    installations of AMENT_PREFIX_PATH, the folders of ROS_PACKAGE_PATH. A folder may be a package itself (it has a
    ``package.xml``), hold packages further below, or hold folders with packages' names.

    Args:
        near: A robot description's file, or its folder; None: nowhere.
        folders: Searched before those of the environment.
    """

    def __init__(
        self, near: str | os.PathLike[str] | None = None, folders: Iterable[str | os.PathLike[str]] = ()
    ) -> None:
        self.near = None if near is None else Path(near).resolve()
        self.folders = [Path(folder) for folder in folders]
        self._found: dict[str, Path] = {}
        self._crawled: dict[tuple[Path, int], dict[str, Path]] = {}

    def find(self, name: str) -> Path:
        """The folder of a package, with all symbolic links resolved.

        Raises:
            PackageError: There is no such package.
        """
        if name not in self._found:
            self._found[name] = self._search(name).resolve()
        return self._found[name]

    def resolve(self, url: str) -> Path:
        """The file that ``package://NAME/PATH`` names.

        A relative path is taken from the folder of ``near``, and must stay inside the package around it, or below that
        folder where there is none.

        Raises:
            PackageError: There is no such package or file, or the file is not inside the package.
        """
        scheme, separator, rest = url.partition("://")
        if not separator:
            return self._inside(url, *self._surroundings(url))
        if scheme != "package":
            raise PackageError(f"{url!r} is no file of a package", hint="Name it as package://PACKAGE/PATH.")
        name, _, path = unquote(rest).partition("/")
        root = self.find(name)
        return self._inside(url, root, root / path)

    def _inside(self, url: str, root: Path, path: Path) -> Path:
        try:
            real = path.resolve()
            if not real.is_relative_to(root):
                raise PackageError(f"{url!r} leads out of {root}", hint="Only files inside a package are read.")
            if not real.is_file():
                raise PackageError(f"{url!r} is not there: no file {real}")
        except (OSError, ValueError, RuntimeError) as error:  # endless links, a NUL, names that are too long
            raise PackageError(f"{url!r} is no file: {error}") from None
        return real

    def _surroundings(self, url: str) -> tuple[Path, Path]:
        if self.near is None:
            raise PackageError(f"{url!r} is relative, and nobody said to what", hint="Use package://PACKAGE/PATH.")
        folder = self.near if self.near.is_dir() else self.near.parent
        return _package_around(folder) or folder, folder / unquote(url)

    def _search(self, name: str) -> Path:
        # No separators, no dots alone, nothing that a file system might take for more than a name.
        if not name or name.startswith(".") or not all(c.isalnum() or c in "_-." for c in name):
            raise PackageError(f"{name!r} cannot be the name of a package")
        for folder in self._near_by():
            if name in self._below(folder, _NEIGHBOURS):
                return self._below(folder, _NEIGHBOURS)[name]
        for folder in [*self.folders, *_listed("COFRAME_PACKAGE_PATH")]:
            found = self._below(folder, _DEEPEST).get(name) or folder / name
            if found.is_dir():
                return found
        for prefix in _listed("AMENT_PREFIX_PATH"):
            if (prefix / "share" / name).is_dir():
                return prefix / "share" / name
        for folder in _listed("ROS_PACKAGE_PATH"):
            if name in self._below(folder, _DEEPEST):
                return self._below(folder, _DEEPEST)[name]
        raise PackageError(
            f"there is no package {name!r}",
            hint="Set COFRAME_PACKAGE_PATH to the folder that holds it (with others: separated as in PATH).",
        )

    def _near_by(self) -> list[Path]:
        """The package around the description, and the folder that holds it and its neighbours."""
        if self.near is None:
            return []
        package = _package_around(self.near)
        return [] if package is None else [package, package.parent]

    def _below(self, folder: Path, deepest: int) -> dict[str, Path]:
        if (folder, deepest) not in self._crawled:
            found: dict[str, Path] = {}
            packages = list(_crawl(folder, deepest))
            for package in packages:
                found.setdefault(_name(package), package)
            for package in packages:  # some are installed under another name than their own
                found.setdefault(package.name, package)
            self._crawled[folder, deepest] = found
        return self._crawled[folder, deepest]


def _listed(variable: str) -> Iterator[Path]:
    """The existing folders that an environment variable lists."""
    entries = os.environ.get(variable, "").split(os.pathsep)
    return (Path(entry) for entry in entries if entry and Path(entry).is_dir())


def _package_around(path: Path) -> Path | None:
    return next((folder for folder in [path, *path.parents] if (folder / _MANIFEST).is_file()), None)


def _crawl(folder: Path, deepest: int) -> Iterator[Path]:
    """Packages at or below a folder; there are none inside others."""
    if (folder / _MANIFEST).is_file():
        yield folder
        return
    if deepest == 0:
        return
    try:
        inside = sorted(entry.name for entry in os.scandir(folder) if entry.is_dir(follow_symlinks=False))
    except OSError:  # not for our eyes
        return
    for name in inside:
        if not name.startswith(".") and name not in _NOT_SEARCHED:
            yield from _crawl(folder / name, deepest - 1)


def _name(package: Path) -> str:
    """As its manifest has it, else that of its folder."""
    try:
        name = ET.parse(package / _MANIFEST).findtext("name") or ""  # noqa: S314
    except (OSError, ET.ParseError, ValueError, LookupError):
        name = ""
    return name.strip() or package.name
