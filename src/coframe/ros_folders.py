# SPDX-License-Identifier: Apache-2.0
"""Where coframe's ROS packages are, and which ROS packages Python would import from another folder."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Final

from coframe.existence import is_file

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
            if is_file(folder / package / "__init__.py"):
                found.setdefault(package, str(folder))
    return found
