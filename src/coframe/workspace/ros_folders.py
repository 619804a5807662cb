# SPDX-License-Identifier: Apache-2.0
"""Locate coframe's ROS packages, and find ROS packages that Python would import from other folders."""

from __future__ import annotations

import functools
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from coframe._files.existence import is_file, resolved

if TYPE_CHECKING:
    from collections.abc import Iterable
    from types import ModuleType

# The packages that share message classes and nodes. Packages that only use them, such as tf2_sensor_msgs, are not
# listed: they work with either side.
PACKAGES: Final = (
    "rclpy",
    "tf2_py",
    "tf2_ros",
    "tf2_msgs",
    "geometry_msgs",
    "sensor_msgs",
    "std_msgs",
    "nav_msgs",
    "builtin_interfaces",
    "rcl_interfaces",
    "rosgraph_msgs",
    "visualization_msgs",
    "std_srvs",
    "action_msgs",
    "unique_identifier_msgs",
)


@functools.cache
def ros_folder() -> Path:
    """Return the folder of coframe's ROS packages: next to coframe in a checkout, inside it when installed."""
    package = Path(__file__).resolve().parents[1]
    inside = package / "ros"
    return inside if inside.is_dir() else package.parent / "ros"


def is_coframes(module: ModuleType) -> bool:
    """Return whether a module was imported from the folder of coframe's ROS packages."""
    if module.__file__ is None:
        return False
    # The usual path is compared as text, which takes a tenth of the time of resolving links.
    is_inside = module.__file__.startswith(f"{ros_folder()}{os.sep}") and ".." not in module.__file__
    return is_inside or Path(module.__file__).resolve().is_relative_to(ros_folder())


def imported_packages() -> list[ModuleType]:
    """Return the packages of `PACKAGES` that this process has imported, from any folder."""
    return [sys.modules[name] for name in PACKAGES if getattr(sys.modules.get(name), "__file__", None)]


def folders_after_ros(path: Iterable[str]) -> list[str]:
    """Return the folders of a search path after the folder of coframe's ROS packages; [] if it is not on the path."""
    entries, home = list(path), ros_folder()
    return [entry for entry in entries[_position(entries) + 1 :] if Path(entry or ".").resolve() != home]


@functools.lru_cache(maxsize=4)  # Every ROS package of coframe calls this when it is imported.
def foreign_packages(path: tuple[str, ...]) -> dict[str, str]:
    """Find the ROS packages that would be imported from a folder other than coframe's.

    Folders after coframe's count only if they have a complete ROS 2, because coframe's packages are found last.
    Otherwise, they contain packages of ROS 1, such as Debian's, which do not belong to an rclpy.

    Args:
        path: Folders in search order, such as `sys.path`.

    Returns:
        The folder of each such package, by package name.
    """
    entries = list(path)
    before, after = _packages_in(entries[: _position(entries)]), _packages_in(folders_after_ros(entries))
    return {**after, **before} if "rclpy" in after else before


def _packages_in(path: Iterable[str]) -> dict[str, str]:
    found: dict[str, str] = {}
    for entry in path:
        for package in PACKAGES:
            if is_file(Path(entry or ".") / package / "__init__.py"):
                found.setdefault(package, entry or ".")
    return found


def _position(path: list[str]) -> int:
    """Return the index of the folder of coframe's ROS packages, or the length of the path."""
    home = ros_folder()
    return next((index for index, entry in enumerate(path) if resolved(entry or ".") == home), len(path))
