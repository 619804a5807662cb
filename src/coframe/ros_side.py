"""All ROS packages come from one side: from here, or from a ROS installation on the path; never from both."""

from __future__ import annotations

import functools
import sys
from pathlib import Path
from typing import Final

PACKAGES: Final = (
    "rclpy",
    "tf2_py",
    "tf2_ros",
    "tf2_geometry_msgs",
    "tf2_sensor_msgs",
    "tf2_msgs",
    "geometry_msgs",
    "sensor_msgs",
    "sensor_msgs_py",
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


def ours() -> Path:
    """The folder of our ROS packages: beside the package in a checkout, inside it in an installation."""
    package = Path(__file__).resolve().parent
    inside = package / "ros"
    return inside if inside.is_dir() else package.parent / "ros"


@functools.lru_cache(maxsize=1)  # every package of ours asks
def foreign_packages(path: tuple[str, ...]) -> dict[str, str]:
    """Finds packages that would be imported from elsewhere.

    Args:
        path: Folders in the order of the search, such as `sys.path`.

    Returns:
        Package -> the folder it would come from.
    """
    home = ours()
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
    """Refuses a mixture of our packages with those of a ROS installation.

    Args:
        importing: Our package that is being imported.
        path: Folders in the order of the search; None: `sys.path`.

    Raises:
        ImportError: Some of the packages would come from elsewhere.
    """
    found = foreign_packages(tuple(sys.path if path is None else path))
    if not found:
        return
    names = ", ".join(sorted(found))
    folders = ", ".join(sorted(set(found.values())))
    raise ImportError(
        f"coframe's {importing} is being imported, but {names} would come from {folders}, and the two do not mix: "
        "source a complete ROS 2 so that everything comes from there, or take that folder out of PYTHONPATH so that "
        "everything comes from coframe"
    )
