# SPDX-License-Identifier: Apache-2.0
"""Search for packages in installation prefixes (`AMENT_PREFIX_PATH`) and in source directories.

`COFRAME_PACKAGE_PATH` lists directories that contain packages as in a source tree, `<directory>/<package>/...`. These
packages do not need to be built or installed. The workspace around the current directory is also searched.
"""

import re
from pathlib import Path

from ament_index_python.constants import AMENT_PREFIX_PATH_ENV_VAR
from coframe.errors import PackageError
from coframe.workspace.packages.finding import find_package, package_names
from coframe.workspace.packages.folders import existing_folders

__all__ = [
    "PackageNotFoundError",
    "get_package_prefix",
    "get_package_share_directory",
    "get_package_share_path",
    "get_packages_with_prefixes",
]

COFRAME_PACKAGE_PATH = "COFRAME_PACKAGE_PATH"

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_\-]*")


class PackageNotFoundError(KeyError):
    """No package with this name exists in the searched directories."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


def get_package_prefix(package_name: str) -> str:
    """Return the installation prefix of a package. For a package in `COFRAME_PACKAGE_PATH`, return that directory.

    Raises:
        PackageNotFoundError: The package was not found.
        ValueError: The name is not a valid package name.
    """
    return str(_find(package_name)[0])


def get_package_share_directory(package_name: str, print_warning: bool = True) -> str:
    """Return the share directory of a package, which contains its launch files, robot descriptions and meshes.

    Args:
        package_name: Name of the package.
        print_warning: Ignored, accepted for compatibility. A missing directory is always an error.

    Raises:
        PackageNotFoundError: The package was not found.
        ValueError: The name is not a valid package name.
    """
    del print_warning
    return str(_find(package_name)[1])


def get_package_share_path(package_name: str, print_warning: bool = True) -> Path:
    """Return the share directory of a package as a Path. See `get_package_share_directory`."""
    return Path(get_package_share_directory(package_name, print_warning))


def get_packages_with_prefixes() -> dict[str, str]:
    """Return the names of all packages with their prefixes. The first prefix that contains a package applies."""
    found = [find_package(name) for name in package_names()]
    return {package.name: str(package.prefix) for package in found}


def _find(package_name: str) -> tuple[Path, Path]:
    """Return the prefix and the share directory of a package."""
    if not _NAME.fullmatch(package_name):
        raise ValueError(f"'{package_name}' is not a valid package name")
    try:
        package = find_package(package_name)
    except PackageError as error:
        searched = [
            str(folder)
            for name in (AMENT_PREFIX_PATH_ENV_VAR, COFRAME_PACKAGE_PATH)
            for folder in existing_folders(name)
        ]
        raise PackageNotFoundError(
            f"package '{package_name}' not found, searching: {searched}. {error.hint} "
            f"Set {COFRAME_PACKAGE_PATH} to the directory that contains the package directory."
        ) from None
    return package.prefix, package.share
