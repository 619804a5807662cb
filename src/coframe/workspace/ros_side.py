# SPDX-License-Identifier: Apache-2.0
"""Check that all ROS packages are imported from the same side: coframe or a ROS installation, never both.

The exception is tf2, which `coframe.ros2` replaces in a ROS installation.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Final

from coframe.workspace import _finders
from coframe.workspace.ros_folders import foreign_packages, imported_packages, is_coframes

TF2_PACKAGES: Final = ("tf2_py", "tf2_ros")

_state = {"tf2_is_replaced": False}
_listeners = {"wire": ""}


def tf2_is_replaced() -> bool:
    """Return whether coframe's tf2_py and tf2_ros are used with the rclpy and the messages of a ROS installation."""
    return _state["tf2_is_replaced"]


def allow_tf2() -> None:
    """Allow coframe's tf2_py and tf2_ros to be used with the rclpy and the messages of a ROS installation."""
    _state["tf2_is_replaced"] = True


def choose_listener_wire(wire: str) -> None:
    """Let the listeners of this process receive transforms in a way, with priority over COFRAME_ROS2_WIRE.

    Args:
        wire: "native" or "rclpy".
    """
    _listeners["wire"] = wire


def listener_wire() -> str:
    """Return what `choose_listener_wire` has chosen, or "" if nothing was chosen."""
    return _listeners["wire"]


def check(importing: str, path: list[str] | None = None) -> None:
    """Raise ImportError if coframe's ROS packages would be mixed with packages of a ROS installation.

    Otherwise, make users' interface packages importable.

    Args:
        importing: Name of coframe's ROS package that is being imported.
        path: Folders in search order; None means `sys.path`.

    Raises:
        ImportError: Some of the packages would be imported from another folder.
    """
    if importing in TF2_PACKAGES and tf2_is_replaced():
        return
    found = foreign_packages(tuple(sys.path if path is None else path))
    if not found:
        if path is None:
            _check_imported(importing)
        _finders.install()
        return
    names = ", ".join(sorted(found))
    folders = ", ".join(sorted(set(found.values())))
    raise ImportError(
        f"cannot import coframe's {importing}: {names} would be imported from {folders}, and packages of coframe and "
        "of a ROS installation cannot be mixed. Source a complete ROS 2 to import all of them from there, or remove "
        "this folder from PYTHONPATH to import all of them from coframe."
    )


def _check_imported(importing: str) -> None:
    """Raise ImportError if ROS packages of other folders are already imported, such as Debian's ROS 1 packages."""
    others = [module for module in imported_packages() if not is_coframes(module)]
    if others:
        names = ", ".join(module.__name__ for module in others)
        folders = ", ".join(sorted({str(Path(module.__file__ or "").parent.parent) for module in others}))
        raise ImportError(
            f"cannot import coframe's {importing}: {names} was imported from {folders}, and packages of coframe and of "
            f"a ROS installation cannot be mixed. Import {importing} first: then all of them come from coframe."
        )
