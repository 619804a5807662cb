# SPDX-License-Identifier: Apache-2.0
"""The file system view of a student's program: the system, Python with its packages, ROS, and its own folder."""

from __future__ import annotations

import contextlib
import importlib.metadata
import json
import os
import stat
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple
from urllib.parse import unquote, urlparse

from coframe._files.existence import exists

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

__all__ = ["View", "private_folders", "view_of"]

# Folders of the system and of package managers. Devices and processes are excluded.
_SYSTEM: Final = (
    *("/bin", "/etc", "/lib", "/lib32", "/lib64", "/opt", "/sbin", "/sys/devices/system", "/usr"),
    *("/gnu/store", "/home/linuxbrew", "/nix/store", "/snap"),
)
# Environment variables that list installation prefixes, and folders of packages and libraries.
_INSTALLATIONS: Final = ("AMENT_PREFIX_PATH", "VIRTUAL_ENV")
_INSTALLATION_PARTS: Final = ("bin", "etc", "include", "lib", "lib64", "local", "pyvenv.cfg", "share", "ssl")
_FOLDERS: Final = ("LD_LIBRARY_PATH", "PYTHONPATH")
_CONFIGURATION: Final = "/etc"
_WORLD_READABLE = 0o4  # the permission bit that lets all users read a file
_DDS_CONFIGURATION: Final = "CYCLONEDDS_URI"
_PRIVATE_FOLDERS: Final = ("/", "/home", "/root", "/run", "/tmp", "/var/tmp")  # noqa: S108 - they are kept out
_MEMORY_MAPS = Path("/proc/self/maps")
_MAX_LINKS = 40  # maximum number of links in a path, as in the kernel


class View(NamedTuple):
    """The paths that a program can access.

    Attributes:
        entries: Absolute paths without symbolic links, sorted, and whether each can be read. The longest matching path
            decides; a file below none of them cannot be read.
        links: Symbolic links to these paths, and their targets.
    """

    entries: list[tuple[str, bool]]
    links: list[tuple[str, str]]


def private_folders(folder: Path) -> list[str]:
    """Return private folders of the user who runs the check, which programs may not read completely.

    Args:
        folder: The student's folder; its parent contains the folders of other students.
    """
    found = [Path(path) for path in (*_PRIVATE_FOLDERS, tempfile.gettempdir())]
    found += [Path.cwd(), folder.resolve().parent, *_sources()]
    home = os.path.expanduser("~")  # noqa: PTH111 - pathlib fails if there is none
    found += [Path(path) for path in (home, _account_home()) if os.path.isabs(path)]  # noqa: PTH117
    return sorted({os.path.realpath(path) for path in found})


def view_of(folder: Path, private_folders: Iterable[str], solutions: Iterable[str]) -> View:
    """Return the view of a program.

    Args:
        folder: The folder of the program.
        private_folders: Folders in which only installed packages and the program's folder can be read.
        solutions: Folders that cannot be read.
    """
    own = os.path.realpath(folder)
    # A file below a package folder belongs to a package, even if this process runs in that folder.
    packages = {os.path.realpath(path) for path in sysconfig.get_paths().values()}
    hidden = {path for path in private_folders if not any(_is_below(path, each) for each in packages)}
    installed = {os.path.realpath(path) for path in _installations()} - {*map(os.path.realpath, _PRIVATE_FOLDERS)}
    installed = {part for path in installed for part in _find_installed_parts(path, hidden)}
    others = {os.path.realpath(path) for path in _packages()}
    others = {path for path in others if not any(_is_below(each, path) for each in hidden)}
    readable = {own} | {path for path in installed | others if exists(Path(path))}
    hidden = {path for path in hidden - readable if not _is_below(path, own)}
    hidden |= (secret := {*map(os.path.realpath, solutions), *_find_secrets()})
    readable = {path for path in readable if path == own or not any(_is_below(path, each) for each in secret)}
    return View(_remove_redundant(readable, hidden - {own}), sorted(_links(own)))


def _remove_redundant(readable: set[str], hidden_paths: set[str]) -> list[tuple[str, bool]]:
    """Return the entries without redundant ones."""
    found: dict[str, bool] = {}
    for path in sorted(readable | hidden_paths):
        is_readable = path in readable
        above = max((each for each in found if _is_below(path, each)), key=len, default=None)
        if is_readable != (above is not None and found[above]):
            found[path] = is_readable
    return list(found.items())


def _is_below(path: str, folder: str) -> bool:
    """Return whether a path is a folder or inside it."""
    return path == folder or path.startswith(folder.rstrip("/") + "/")


def _installations() -> Iterator[str]:
    yield from (*_SYSTEM, sys.prefix, sys.base_prefix, sys.exec_prefix, sys.base_exec_prefix)
    yield from _folders_in_variables(_INSTALLATIONS)


def _find_installed_parts(path: str, private_folders: set[str]) -> Iterator[str]:
    """Yield an installation; only its own folders if it is in a folder with other files, such as a project."""
    is_system = any(_is_below(path, os.path.realpath(folder)) for folder in _SYSTEM)
    if is_system or not any(_is_below(each, path) for each in private_folders):
        yield path
    else:
        yield from (f"{path}/{name}" for name in _INSTALLATION_PARTS)


def _packages() -> Iterator[str]:
    yield from (path for path in sys.path if os.path.isabs(path))  # noqa: PTH117
    yield from _folders_in_variables(_FOLDERS)
    yield from _absolute_path(os.environ.get(_DDS_CONFIGURATION, "").removeprefix("file://"))
    # The packages and libraries that the grader itself has loaded.
    for module in tuple(sys.modules.values()):
        yield from _absolute_path(os.path.dirname(getattr(module, "__file__", None) or ""))  # noqa: PTH120
    if _MEMORY_MAPS.is_file():
        for line in _MEMORY_MAPS.read_text(errors="replace").splitlines():
            if "/" in line:
                yield os.path.dirname("/" + line.partition("/")[2])  # noqa: PTH120


def _find_secrets() -> Iterator[str]:
    """Yield configuration files that not everyone may read, because root and therefore programs could read them."""
    for path, folders, files in os.walk(_CONFIGURATION):
        for name in (*files, *folders):
            entry = os.path.join(path, name)  # noqa: PTH118 - fast, for some thousand files
            with contextlib.suppress(OSError):
                mode = os.lstat(entry).st_mode
                if not (mode & _WORLD_READABLE or stat.S_ISLNK(mode)):
                    folders[:] = [each for each in folders if each != name]
                    yield entry


def _folders_in_variables(variables: Iterable[str]) -> Iterator[str]:
    for name in variables:
        for path in os.environ.get(name, "").split(os.pathsep):
            yield from _absolute_path(path)


def _absolute_path(path: str) -> Iterator[str]:
    if os.path.isabs(path):  # noqa: PTH117
        yield path


def _links(own_folder: str) -> Iterator[tuple[str, str]]:
    """Yield the symbolic links in the paths through which programs find readable files."""
    found: dict[str, str] = {}
    for path in {own_folder, sys.executable, *_installations(), *_packages()}:
        rest, place = path.split("/")[:0:-1], "/"
        while rest and len(found) < _MAX_LINKS * _MAX_LINKS:
            name = rest.pop()
            place = os.path.normpath(os.path.join(place, name))  # noqa: PTH118
            if place not in found and os.path.islink(place):  # noqa: PTH114
                found[place] = os.readlink(place)  # noqa: PTH115
                rest.extend(found[place].split("/")[::-1])
                place = "/" if found[place].startswith("/") else os.path.dirname(place)  # noqa: PTH120
    yield from found.items()


def _sources() -> list[Path]:
    """Return the folder or file from which coframe was installed, because it may contain solutions."""
    try:
        text = importlib.metadata.distribution("coframe").read_text("direct_url.json")
        address = urlparse(json.loads(text or "{}").get("url", ""))
    except (importlib.metadata.PackageNotFoundError, ValueError, AttributeError):
        return []
    return [Path(unquote(address.path))] if address.scheme == "file" else []


def _account_home() -> str:
    try:
        import pwd  # noqa: PLC0415 - not on Windows

        return pwd.getpwuid(os.getuid()).pw_dir
    except (ImportError, KeyError):
        return ""
