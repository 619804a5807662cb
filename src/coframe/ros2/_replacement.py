# SPDX-License-Identifier: Apache-2.0
"""Replace tf2_py and tf2_ros of a sourced ROS with coframe's."""

from __future__ import annotations

import sys
from importlib.machinery import PathFinder
from typing import TYPE_CHECKING

from coframe.wire.dds.config import reach_subnet_by_default
from coframe.workspace import ros_side
from coframe.workspace.ros_folders import foreign_packages, is_coframes, ros_folder

if TYPE_CHECKING:
    from collections.abc import Sequence
    from importlib.machinery import ModuleSpec
    from types import ModuleType


def install() -> None:
    """Make imports of tf2_py and tf2_ros find coframe's, if a ROS installation is sourced. A second call has no effect.

    Raises:
        ImportError: The packages of the ROS are already imported.
    """
    if ros_side.tf2_is_replaced() or not foreign_packages(tuple(sys.path)):
        return
    for name in ros_side.TF2_PACKAGES:
        if (module := sys.modules.get(name)) is not None and not is_coframes(module):
            raise ImportError(
                f"coframe.ros2 replaces {name}, but {name} is already imported from {module.__file__}. "
                "Import coframe.ros2 before tf2_ros and before packages that import it, such as tf2_geometry_msgs, "
                "or run the program with: python -m coframe.ros2 PROGRAM.py"
            )
    # The native subscriptions must reach the nodes that this ROS reaches. ROS_LOCALHOST_ONLY=1 has priority.
    reach_subnet_by_default()
    ros_side.allow_tf2()
    sys.meta_path.insert(0, _Finder())


class _Finder:
    """A finder of coframe's tf2 packages. Their submodules are found in the folder of the package, as usual."""

    @staticmethod
    def find_spec(
        name: str, _path: Sequence[str] | None = None, _target: ModuleType | None = None
    ) -> ModuleSpec | None:
        return PathFinder.find_spec(name, [str(ros_folder())]) if name in ros_side.TF2_PACKAGES else None
