# SPDX-License-Identifier: Apache-2.0
"""Find ROS packages, with or without ROS, and files of ``package://`` URLs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import unquote

from coframe._files.existence import is_dir, resolved
from coframe._files.os_errors import reason
from coframe._files.regular_files import UnsuitableFileError, check_regular
from coframe.errors import PackageError
from coframe.workspace.packages.folders import by_name, crawl, existing_folders, package_around
from coframe.workspace.packages.share_view import share_of_source, source_of

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable

__all__ = ["Packages"]

_MAX_DEPTH = 4  # levels of folders between a workspace and its packages
_NEIGHBOR_DEPTH = 2  # fewer, because the folder around a package may be large, such as a home folder
# The meshes of the lab's robot are part of coframe.
_OWN_PACKAGES = {"coframe_lab": Path(__file__).parents[1] / "lab"}
_SEARCH_HINT = "coframe searches the folders of COFRAME_PACKAGE_PATH."


class Packages:
    """Finds packages by name.

    It searches, in this order: the package that contains `description_path` and its siblings, `folders`, the folders in
    COFRAME_PACKAGE_PATH, the installations in AMENT_PREFIX_PATH, and the folders in ROS_PACKAGE_PATH. A folder can be a
    package (it has a ``package.xml``), contain packages in subfolders, or contain folders with the names of packages.

    Args:
        description_path: The file of a robot description, or its folder.
        folders: Folders to search before those of the environment.
    """

    def __init__(
        self, description_path: str | os.PathLike[str] | None = None, folders: Iterable[str | os.PathLike[str]] = ()
    ) -> None:
        self.description_path = None if description_path is None else resolved(description_path)
        self.folders = [Path(folder) for folder in folders]
        self._found_folders: dict[str, Path] = {}
        self._crawled_packages: dict[tuple[Path, int], dict[str, Path]] = {}

    def find(self, name: str) -> Path:
        """Return the folder of a package, with all symbolic links resolved.

        Raises:
            PackageError: The package is not found.
        """
        if name not in self._found_folders:
            try:
                found = self._search(name)
            except PackageError:
                if name not in _OWN_PACKAGES:
                    raise
                found = _OWN_PACKAGES[name]
            self._found_folders[name] = share_of_source(found.resolve(), name)
        return self._found_folders[name]

    def resolve(self, url: str) -> Path:
        """Return the file of a URL ``package://NAME/PATH`` or a relative path.

        A relative path is resolved against the folder of `description_path`. It must point to a file in the package
        that contains this folder, or below the folder if there is no such package.

        Raises:
            PackageError: The package or the file does not exist, or the file is outside the package.
        """
        scheme, separator, rest = url.partition("://")
        if not separator:
            return self._check_inside(url, *self._surrounding_packages(url))
        if scheme != "package":
            raise PackageError(f"{url!r} is not a package URL", hint=f"Use package://PACKAGE/PATH. {_SEARCH_HINT}")
        name, _, path = unquote(rest).partition("/")
        root = self.find(name)
        return self._check_inside(url, root, root / path)

    def _check_inside(self, url: str, root: Path, path: Path) -> Path:
        try:
            real = path.resolve()
            if not (real.is_relative_to(root) or real.is_relative_to(source_of(root))):
                raise PackageError(
                    f"{url!r} is outside {root}", hint=f"Only files inside the package can be read. {_SEARCH_HINT}"
                )
            check_regular(real)
        except FileNotFoundError:
            raise PackageError(
                f"{url!r} does not exist: there is no file {real}",
                hint=f"Check the spelling, and whether this is the right copy of the package. {_SEARCH_HINT}",
            ) from None
        except UnsuitableFileError as error:
            raise PackageError(f"{url!r}: {error}", hint=_SEARCH_HINT) from None
        except (OSError, ValueError, RuntimeError) as error:  # circular links, NUL characters, names that are too long
            raise PackageError(f"{url!r} is not a valid file name: {reason(error)}", hint=_SEARCH_HINT) from None
        return real

    def _surrounding_packages(self, url: str) -> tuple[Path, Path]:
        if self.description_path is None:
            raise PackageError(
                f"{url!r} is relative, but the robot description has no file",
                hint=f"Use package://PACKAGE/PATH. {_SEARCH_HINT}",
            )
        folder = self.description_path if self.description_path.is_dir() else self.description_path.parent
        return package_around(folder) or folder, folder / unquote(url)

    def _search(self, name: str) -> Path:
        # The name must not contain path separators or anything else that points to another folder.
        if not name or name.startswith(".") or not all(c.isalnum() or c in "_-." for c in name):
            raise PackageError(
                f"{name!r} is not a valid package name", hint=f"Use letters, digits, '_', '-' and '.'. {_SEARCH_HINT}"
            )
        for folder in self._nearby_folders():
            if name in self._packages_below(folder, _NEIGHBOR_DEPTH):
                return self._packages_below(folder, _NEIGHBOR_DEPTH)[name]
        for folder in [*self.folders, *existing_folders("COFRAME_PACKAGE_PATH")]:
            found = self._packages_below(folder, _MAX_DEPTH).get(name) or folder / name
            if is_dir(found):
                return found
        for prefix in existing_folders("AMENT_PREFIX_PATH"):
            if is_dir(prefix / "share" / name):
                return prefix / "share" / name
        for folder in existing_folders("ROS_PACKAGE_PATH"):
            if name in self._packages_below(folder, _MAX_DEPTH):
                return self._packages_below(folder, _MAX_DEPTH)[name]
        raise PackageError(
            f"no package named {name!r}",
            hint="Add the folder that contains it to COFRAME_PACKAGE_PATH (folders are separated as in PATH).",
        )

    def _nearby_folders(self) -> list[Path]:
        """Return the package that contains the description, and the folder with its siblings."""
        if self.description_path is None:
            return []
        package = package_around(self.description_path)
        return [] if package is None else [package, package.parent]

    def _packages_below(self, folder: Path, max_depth: int) -> dict[str, Path]:
        if (folder, max_depth) not in self._crawled_packages:
            self._crawled_packages[folder, max_depth] = by_name(list(crawl(folder, max_depth)))
        return self._crawled_packages[folder, max_depth]
