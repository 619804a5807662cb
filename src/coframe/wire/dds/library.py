# SPDX-License-Identifier: Apache-2.0
"""Find the C library of Cyclone DDS, `libddsc`, on this machine.

It is searched for in this order: the file in `COFRAME_DDS_LIBRARY`; the `cyclonedds` package; the folder `_bundled` of
coframe's own wheels; a sourced ROS 2; the system. No other part of the `cyclonedds` package is used.
"""

from __future__ import annotations

import importlib.util
import os
import platform
import re
import sys
import sysconfig
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from coframe import _core
from coframe._files.existence import is_dir, is_file
from coframe._process.optional_imports import pip_install
from coframe.errors import WireError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

VARIABLE: Final = "COFRAME_DDS_LIBRARY"
SUPPORTED: Final = "Cyclone DDS 0.10 and 11"
BUNDLED: Final = Path(__file__).parents[2] / "_bundled"

_NAMES: Final = {"win32": ["ddsc*.dll", "cycloneddsc*.dll"], "darwin": ["libddsc*.dylib"]}
_VERSION: Final = re.compile(r"\.so\.(\d[\d.]*)$|\.(\d[\d.]*)\.dylib$")
_SUPPORTED_VERSION: Final = re.compile(r"0|0\.10(\..*)?|11(\..*)?")
_SEARCH_PATH: Final = {"win32": "PATH", "darwin": "DYLD_LIBRARY_PATH"}


@dataclass(frozen=True)
class Place:
    """A place where the library may be.

    Attributes:
        source: The provider of the library, such as "the cyclonedds package".
        searched: The file or the folders that were searched, or a description of what is missing.
        path: The library, or None if it was not found.
    """

    source: str
    searched: str
    path: Path | None

    @property
    def version(self) -> str:
        """The version in the name of the file; empty if the name has none."""
        return "" if self.path is None else file_version(self.path)


@dataclass(frozen=True)
class Library:
    """The library that this process uses.

    Attributes:
        place: The place where it was found.
        release: The release with the same binary interface: "0.10" or "11".
        refused: One message for each library that comes earlier in the search order but cannot be loaded.
    """

    place: Place
    release: str
    rejected: tuple[str, ...] = ()

    @property
    def version(self) -> str:
        """The version in the name of the file if it has one, otherwise the release."""
        return self.place.version or self.release


_loaded: list[Library] = []


def load() -> Library:
    """Load the first usable library into the native core. Later calls return the same library.

    Raises:
        WireError: There is no library, or none that can be used.
    """
    if not _loaded:
        _loaded.append(_first_usable(places()))
    return _loaded[0]


def loaded() -> Library | None:
    """Return the library that is loaded, or None if there is none."""
    return _loaded[0] if _loaded else None


def check() -> None:
    """Check that there is a library, without loading it.

    Raises:
        WireError: There is none.
    """
    searched = list(places())
    if all(place.path is None for place in searched):
        raise _missing_library_error(searched)


def places(environment: Mapping[str, str] = os.environ) -> Iterator[Place]:
    """Yield the places where the library may be, in the order in which they are searched.

    If the environment variable COFRAME_DDS_LIBRARY is set, that is the only place.
    """
    if named := environment.get(VARIABLE, "").strip():
        path = Path(named)
        yield (
            _in_folders(VARIABLE, [path]) if is_dir(path) else Place(VARIABLE, named, path if is_file(path) else None)
        )
        return
    yield _of_package()
    yield _in_folders("coframe's own wheel", [BUNDLED])
    yield _of_ros(environment)
    yield _in_folders("the system", _system_folders(environment))


def file_version(path: Path) -> str:
    """Return the version in the name of the library's file, such as "0.10.2", or "" if the name has none."""
    found = _VERSION.search(path.resolve().name)
    return found[1] or found[2] if found else ""


def how_to_get_one() -> str:
    """Return advice on how to install the library on this platform."""
    ways = []
    if _package_has_wheels():
        ways.append(pip_install("dds"))
    if sys.platform == "linux":
        ways.append("sudo apt-get install libddsc0t64 (on Debian 12: libddsc0debian)")
    ways.append(f"{pip_install('zenoh')} to use Zenoh instead of DDS")
    ways += ["source a ROS 2 that has rmw_cyclonedds_cpp", f"set {VARIABLE} to the file of a libddsc"]
    return "Use one of these options: " + "; ".join(ways) + "."


def _first_usable(searched: Iterator[Place]) -> Library:
    looked, rejected = [], []
    for place in searched:
        looked.append(place)
        if place.path is None:
            continue
        if place.version and not _SUPPORTED_VERSION.fullmatch(place.version):
            rejected.append(_rejection_text(place, "has an incompatible binary interface"))
            continue
        try:
            release = _core.load_dds(str(place.path))
        except RuntimeError as error:
            rejected.append(_rejection_text(place, str(error)))
            continue
        return Library(place, release, tuple(rejected))
    if rejected:
        raise WireError(" ".join(rejected), hint=how_to_get_one())
    raise _missing_library_error(looked)


def _rejection_text(place: Place, reason: str) -> str:
    version = f"version {place.version}, " if place.version else ""  # "version 12.1.0, from the system"
    return (
        f"The DDS library {place.path} ({version}from {place.source}) cannot be used because it {reason}. "
        f"coframe supports {SUPPORTED}."
    )


def _missing_library_error(looked: list[Place]) -> WireError:
    if len(looked) == 1:  # named by the environment variable
        text = f"The DDS library {looked[0].searched} in {VARIABLE} does not exist."
        return WireError(text, hint=f"Unset {VARIABLE} to search the usual places. {how_to_get_one()}")
    return WireError(
        "Joining the ROS graph requires the DDS library libddsc, which is not installed. " + how_to_get_one(),
        hint="`coframe doctor --system` lists the places that were searched. All features of coframe that need no "
        "network work without libddsc.",
    )


def _package_has_wheels() -> bool:
    """Return whether the cyclonedds package has wheels for this Python and this platform, as in pyproject.toml."""
    return sys.version_info < (3, 14) and (sys.platform != "linux" or platform.machine() == "x86_64")


def _of_package() -> Place:
    """Return the library of the cyclonedds package without importing it, which would take more than 100 ms."""
    source = "the cyclonedds package"
    try:
        package = importlib.util.find_spec("cyclonedds")
    except (ImportError, ValueError):  # blocked, for example by tests
        package = None
    if package is None or not package.submodule_search_locations:
        return Place(source, "not installed", None)
    folders = []
    for name in package.submodule_search_locations:
        folder = Path(name)
        # The folders into which wheel repair tools put libraries, on Linux and Windows, and on macOS.
        folders += [folder.with_name("cyclonedds.libs"), folder / ".dylibs", folder / ".libs"]
    return _in_folders(source, folders)


def _of_ros(environment: Mapping[str, str]) -> Place:
    """Return the library of a sourced ROS 2: of the workspaces in AMENT_PREFIX_PATH, then of the loader's path."""
    source = "the sourced ROS 2"
    prefixes = _folders(environment.get("AMENT_PREFIX_PATH", ""))
    if not prefixes:
        return Place(source, "no ROS 2 is sourced (AMENT_PREFIX_PATH is not set)", None)
    folders = []
    for prefix in prefixes:
        folders += [prefix / "bin"] if sys.platform == "win32" else _lib_folders(prefix)
    folders += _folders(environment.get(_SEARCH_PATH.get(sys.platform, "LD_LIBRARY_PATH"), ""))
    return _in_folders(source, folders)


def _system_folders(environment: Mapping[str, str]) -> list[Path]:
    homes = _folders(environment.get("CYCLONEDDS_HOME", ""))
    if sys.platform == "win32":
        return [home / "bin" for home in homes] + _folders(environment.get("PATH", ""))
    if sys.platform == "darwin":
        homes += [Path("/opt/homebrew"), Path("/usr/local")]
        return [home / "lib" for home in homes]
    homes += [Path("/usr/local"), Path("/usr")]
    listed = _folders(environment.get("LD_LIBRARY_PATH", ""))
    return listed + [folder for home in homes for folder in _lib_folders(home)]


def _lib_folders(prefix: Path) -> list[Path]:
    """Return the folders of libraries below `prefix` on Linux and macOS, Debian's first."""
    names = [f"lib/{architecture}"] if (architecture := sysconfig.get_config_var("MULTIARCH")) else []
    return [prefix / name for name in [*names, "lib64", "lib"]]


def _folders(paths: str) -> list[Path]:
    return [Path(path) for path in paths.split(os.pathsep) if path]


def _in_folders(source: str, folders: list[Path]) -> Place:
    """Return the library in the first folder that has one, or the newest if there are several versions."""
    folders = list(dict.fromkeys(folders))
    searched = os.pathsep.join(map(str, folders))
    for folder in filter(is_dir, folders):
        found = [file for name in _NAMES.get(sys.platform, ["libddsc*.so*"]) for file in folder.glob(name)]
        if files := [file for file in found if is_file(file)]:
            return Place(source, searched, max(files, key=_version_key))
    return Place(source, searched, None)


def _version_key(path: Path) -> tuple[list[int], int]:
    """Return a sort key: the newest version is the largest, then the shortest name."""
    return [int(part) for part in file_version(path).split(".") if part], -len(path.name)
