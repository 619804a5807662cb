# SPDX-License-Identifier: Apache-2.0
"""The executables of packages: files in ``lib/PACKAGE``, console scripts of source folders, and built-in ones."""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, NamedTuple

from coframe._files.existence import resolved
from coframe._files.regular_files import open_regular, read_regular_text
from coframe._output.formatting import did_you_mean
from coframe._process.python_children import python_command, python_environment
from coframe.distributions import current
from coframe.errors import PackageError
from coframe.workspace.packages import _builtin, _console_scripts
from coframe.workspace.packages.finding import Package, candidates, find_package, source_roots
from coframe.workspace.packages.folders import crawl, package_name

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

__all__ = ["Executable", "executables", "find_executable", "module_folders"]

# install(PROGRAMS scripts/a.py DESTINATION lib/${PROJECT_NAME}) in a CMakeLists.txt
_INSTALL = re.compile(r"\binstall\s*\(([^()]*)\)", re.IGNORECASE)
_ENTRY_POINT = tuple(python_command("coframe.workspace.entry_point"))
_MAX_NAMES = 30  # in an error message
_MAX_DEPTH = 4


class Executable(NamedTuple):
    """An executable of a package.

    Attributes:
        package: Name of the package.
        name: Name of the executable.
        command: The command line that starts it.
        python_path: Folders to prepend to PYTHONPATH.
    """

    package: str
    name: str
    command: tuple[str, ...]
    python_path: tuple[str, ...] = ()

    def environment(self, base: Mapping[str, str] | None = None) -> dict[str, str]:
        """Return the environment to start it with; `base` is the environment of this process if None."""
        environment = python_environment(base)
        environment.setdefault("ROS_DISTRO", current().name.lower())
        if self.python_path:
            present = environment.get("PYTHONPATH", "")
            environment["PYTHONPATH"] = os.pathsep.join([*self.python_path, *([present] if present else [])])
        return environment


def find_executable(package: str, name: str) -> Executable:
    """Return an executable of a package.

    Raises:
        PackageError: There is no such package or executable; the hint lists similar names.
    """
    find_package(package)
    found = executables(package)
    if name in found:
        return found[name]
    guess = did_you_mean(name, found, limit=3)
    names = sorted(found)
    there = f"Its executables: {', '.join(names[:_MAX_NAMES])}." if names else _executables_hint(package)
    raise PackageError(f"No executable {name!r} in the package {package!r}.", hint=f"{guess} {there}".lstrip())


def executables(package: str) -> dict[str, Executable]:
    """Return the executables of a package by name. An installed one comes before the one in the source folder."""
    found: dict[str, Executable] = {}
    for candidate in candidates(package):
        for name, executable in _executables_of(candidate).items():
            found.setdefault(name, executable)
    return found


def _executables_hint(package: str) -> str:
    share = next(candidates(package)).share
    return (
        f"{share} declares none. coframe reads console_scripts of setup.py, setup.cfg or pyproject.toml, and "
        f"install(PROGRAMS) of "
        "CMakeLists.txt are read; programs in C++ need `colcon build` and a sourced workspace."
    )


def _executables_of(package: Package) -> dict[str, Executable]:
    if package.origin == "installed":
        return _installed_executables(package)
    if package.origin == "builtin":
        return {
            name: Executable(package.name, name, (*_ENTRY_POINT, *words))
            for name, words in _builtin.executables(package.name).items()
        }
    return _from_source(package)


def _installed_executables(package: Package) -> dict[str, Executable]:
    folder = package.prefix / "lib" / package.name
    files = sorted(folder.iterdir()) if folder.is_dir() else []
    return {
        file.name: Executable(package.name, file.name, (str(file),))
        for file in files
        if file.is_file() and os.access(file, os.X_OK) and not file.name.startswith(".")
    }


def _from_source(package: Package) -> dict[str, Executable]:
    source = package.source or package.share
    declared = _console_scripts.read(source)
    path = _python_path(source, declared.root)
    found = {
        name: Executable(package.name, name, (*_ENTRY_POINT, target), path) for name, target in declared.scripts.items()
    }
    for relative in [*declared.files, *_programs_of_cmake(source)]:
        file = source / relative
        if file.is_file() and resolved(file).is_relative_to(resolved(source)):
            found.setdefault(file.name, Executable(package.name, file.name, _command_of(file), path))
    return found


def _python_path(package: Path, root: str) -> tuple[str, ...]:
    """Return the folders of the package and of its neighbors, whose modules it may import."""
    own = [str(resolved(package / root))] if package_name(package) not in _builtin.names() else []
    return tuple(dict.fromkeys([*own, *_module_folders([package.parent])]))


def module_folders() -> list[str]:
    """Return the folders with the Python modules of the packages in source folders, for `sys.path`."""
    return _module_folders(source_roots())


def _module_folders(folders: list[Path]) -> list[str]:
    """Return the folders of modules of packages, except those of packages that coframe has."""
    packages = [package for folder in folders for package in crawl(folder, _MAX_DEPTH)]
    return [
        str(resolved(package / _console_scripts.read(package).root))
        for package in packages
        if _has_modules(package) and package_name(package) not in _builtin.names()
    ]


def _has_modules(package: Path) -> bool:
    names = {package.name, package_name(package)}
    return (package / "setup.py").is_file() or any((package / name / "__init__.py").is_file() for name in names)


def _programs_of_cmake(package: Path) -> list[str]:
    try:
        text = read_regular_text(package / "CMakeLists.txt", _console_scripts.MAX_BYTES)
    except (OSError, UnicodeDecodeError):
        return []
    text = re.sub(r"#.*", "", text)
    installed = [[word.strip('"') for word in match[1].split()] for match in _INSTALL.finditer(text)]
    return [program for words in installed for program in _installed_programs(words)]


def _installed_programs(words: list[str]) -> list[str]:
    """Return the programs among the arguments of install() that are installed below lib."""
    keys = [word.upper() for word in words]
    if keys[:1] != ["PROGRAMS"] or "DESTINATION" not in keys:
        return []
    end = keys.index("DESTINATION")
    return words[1:end] if "".join(words[end + 1 : end + 2]).startswith("lib/") else []


def _command_of(file: Path) -> tuple[str, ...]:
    """Return the command of a script. A Python file needs neither the executable bit nor a first line with #!."""
    if file.suffix == ".py" or _has_python_shebang(file):
        return (*_ENTRY_POINT, str(file))
    return (str(file),)


def _has_python_shebang(file: Path) -> bool:
    with open_regular(file) as stream:
        first = stream.readline(200)
    return first.startswith(b"#!") and b"python" in first
