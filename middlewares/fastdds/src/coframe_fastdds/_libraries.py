# SPDX-License-Identifier: Apache-2.0
"""The libraries of Fast DDS on this machine, in the order in which they are looked for when the module is compiled."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_NAMES: Final = ("libfastdds.so*", "libfastrtps.so*")  # from version 3, and before
_VERSION: Final = re.compile(r"\.so\.(\d[\d.]*)$")


class Library(NamedTuple):
    """A library: where it was looked for, its file, and its version, or "" if the name of the file has none."""

    place: str
    path: Path
    version: str


def libraries(environment: Mapping[str, str] = os.environ) -> list[Library]:
    """Return the libraries that are found, in the order of CMakeLists.txt."""
    found: dict[Path, Library] = {}
    for place, prefix in _prefixes(environment):
        for folder in (prefix / "lib", *sorted(prefix.glob("lib/*-linux-gnu"))):
            for name in _NAMES:
                # Where a folder has copies instead of links, the one with the longest name has the whole version.
                path = max(
                    (path.resolve() for path in folder.glob(name)), key=lambda path: len(path.name), default=None
                )
                if path is not None:
                    version = _VERSION.search(path.name)
                    found.setdefault(path, Library(place, path, version[1] if version else ""))
    return list(found.values())


def lines(used: Path, compiled_for: str, environment: Mapping[str, str] = os.environ) -> list[str]:
    """Return what is said about the libraries.

    Args:
        used: The library that is loaded.
        compiled_for: The version for which the module was compiled.
        environment: The environment variables.
    """
    used = used.resolve()
    minor = ".".join(compiled_for.split(".")[:2])
    text = [f"Fast DDS {compiled_for}: {used}, because coframe-fastdds was compiled for version {minor}"]
    for library in libraries(environment):
        use = "used" if library.path.parent == used.parent else "not used"
        text.append(f"  {library.place}: {library.path}, version {library.version or 'unknown'}: {use}")
    return text


def _prefixes(environment: Mapping[str, str]) -> Iterator[tuple[str, Path]]:
    if own := environment.get("COFRAME_FASTDDS", ""):
        yield "COFRAME_FASTDDS", Path(own)
    for prefix in filter(None, environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)):
        yield "the sourced ROS 2", Path(prefix)
    yield "the Python environment", Path(sys.prefix)
    for prefix in ("/usr/local", "/usr"):
        yield "the system", Path(prefix)
