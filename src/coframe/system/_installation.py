# SPDX-License-Identifier: Apache-2.0
"""The Python, packages and ROS installation that this process uses."""

from __future__ import annotations

import importlib.metadata
import platform
import re
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from coframe.workspace import ros_folders

if TYPE_CHECKING:
    from collections.abc import Mapping

_REQUIREMENT: Final = re.compile(r"""([\w.-]+).*?extra == ['"](\w+)['"]""")
# The extra for developers, and the one that combines others.
_INTERNAL_EXTRAS: Final = {"all", "dev"}


@dataclass(frozen=True)
class Installation:
    """The software of this process.

    Attributes:
        python: The version and the implementation of Python.
        platform: The operating system and the processor.
        packages: The versions of coframe and of the packages that it requires.
        extras: For each extra, the versions of its packages, or None for those that are not installed.
        ros: The name of the sourced ROS 2, "" if its variable is not set, None if no ROS 2 is sourced.
        foreign: The folders of ROS packages that Python does not import from coframe.
        container: Whether this process runs in a container.
    """

    python: str
    platform: str
    packages: dict[str, str | None]
    extras: dict[str, dict[str, str | None]]
    ros: str | None
    foreign: dict[str, str]
    container: bool


def installation(environment: Mapping[str, str]) -> Installation:
    """Return the software of this process."""
    return Installation(
        python=f"{platform.python_version()} ({platform.python_implementation()}{_free_threading_text()})",
        platform=f"{platform.system()} {platform.release()} {platform.machine()}",
        packages={name: _version(name) for name in ("coframe", "numpy")},
        extras=_extras(),
        ros=environment.get("ROS_DISTRO", "") if environment.get("AMENT_PREFIX_PATH") else None,
        foreign=ros_folders.foreign_packages(tuple(sys.path)),
        container=any(Path(name).exists() for name in ("/.dockerenv", "/run/.containerenv")),
    )


def _free_threading_text() -> str:
    return "" if getattr(sys, "_is_gil_enabled", lambda: True)() else ", without the GIL"


def _extras() -> dict[str, dict[str, str | None]]:
    extras: dict[str, dict[str, str | None]] = {}
    try:
        requirements = importlib.metadata.requires("coframe") or []
    except importlib.metadata.PackageNotFoundError:
        return {}
    for requirement in requirements:
        found = _REQUIREMENT.match(requirement)
        if found and found[1] != "coframe" and found[2] not in _INTERNAL_EXTRAS:
            extras.setdefault(found[2], {})[found[1]] = _version(found[1])
    return extras


def _version(package: str) -> str | None:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None
