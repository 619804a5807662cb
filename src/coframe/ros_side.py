# SPDX-License-Identifier: Apache-2.0
"""A check that all ROS packages are imported from one place: coframe or a ROS installation, never both."""

from __future__ import annotations

import sys

from coframe import interface_imports
from coframe.ros_folders import foreign_packages


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
