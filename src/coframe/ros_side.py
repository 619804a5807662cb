# SPDX-License-Identifier: Apache-2.0
"""A check that all ROS packages are imported from one place: coframe or a ROS installation, never both."""

from __future__ import annotations

import functools
import sys
from pathlib import Path
from typing import Final

from coframe import interface_imports

# The packages that share message classes and nodes. Packages that only use them, such as tf2_sensor_msgs, are not here:
# they work with the side that provides these.
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


def ros_folder() -> Path:
    """Return the folder of coframe's ROS packages: next to coframe in a checkout, inside it when installed."""
    package = Path(__file__).resolve().parent
    inside = package / "ros"
    return inside if inside.is_dir() else package.parent / "ros"


@functools.lru_cache(maxsize=1)  # Each of coframe's ROS packages calls this when it is imported.
def foreign_packages(path: tuple[str, ...]) -> dict[str, str]:
    """Find the ROS packages that would be imported from another folder than coframe's.

    Args:
        path: Folders in search order, such as `sys.path`.

    Returns:
        The folder of each such package, by package name.
    """
    home = ros_folder()
    found: dict[str, str] = {}
    for entry in path:
        folder = Path(entry or ".")
        if folder.resolve() == home:
            break
        for package in PACKAGES:
            if (folder / package / "__init__.py").is_file():
                found.setdefault(package, str(folder))
    return found


def check(importing: str, path: list[str] | None = None) -> None:
    """Raise ImportError if coframe's ROS packages would be mixed with those of a ROS installation.

    Otherwise, users' interface packages can be imported from now on.

    Args:
        importing: Name of coframe's ROS package that is being imported.
        path: Folders in search order; None means `sys.path`.

    Raises:
        ImportError: Some of the packages would be imported from another folder.
    """
    found = foreign_packages(tuple(sys.path if path is None else path))
    if not found:
        interface_imports.install()
        return
    names = ", ".join(sorted(found))
    folders = ", ".join(sorted(set(found.values())))
    raise ImportError(
        f"cannot import coframe's {importing}: {names} would be imported from {folders}, and packages of coframe and "
        "of a ROS installation cannot be mixed. Source a complete ROS 2 to import all of them from there, or remove "
        "this folder from PYTHONPATH to import all of them from coframe."
    )
