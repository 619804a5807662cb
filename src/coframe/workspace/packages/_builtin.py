# SPDX-License-Identifier: Apache-2.0
"""The executables of the ROS packages that coframe provides."""

from __future__ import annotations

import functools
import importlib.util
from pathlib import Path
from typing import Final

from coframe.workspace.ros_folders import ros_folder

__all__ = ["COMPONENTS", "EXECUTABLES", "names", "share"]

_COMMAND: Final = "coframe.cli:main"
_DEMOS: Final = ("talker", "listener", "add_two_ints_server", "add_two_ints_client")
_PYTHON_DEMOS: Final = (*_DEMOS, "talker_qos", "listener_qos")
_CPP_DEMOS: Final = (*_DEMOS, "parameter_blackboard")
_CONTAINERS: Final = ("component_container", "component_container_mt", "component_container_isolated")
# Packages with the files of others.
_FOLDERS: Final = {
    "composition": "demo_nodes_py",
    "demo_nodes_cpp": "demo_nodes_py",
    "rclcpp_components": "rclpy_components",
}
# Package -> executable -> its function, and arguments. A module that is not installed has no executable.
EXECUTABLES: Final[dict[str, dict[str, tuple[str, ...]]]] = {
    "robot_state_publisher": {"robot_state_publisher": ("robot_state_publisher:main",)},
    "joint_state_publisher": {"joint_state_publisher": ("joint_state_publisher:main",)},
    "joint_state_publisher_gui": {"joint_state_publisher_gui": (_COMMAND, "joints", "--gui")},
    "tf2_ros": {
        "static_transform_publisher": (_COMMAND, "static"),
        "tf2_echo": (_COMMAND, "echo"),
        "tf2_monitor": (_COMMAND, "monitor", "--classic"),
        "buffer_server": ("tf2_ros.buffer_server.__main__:main",),
    },
    "tf2_tools": {"view_frames": (_COMMAND, "frames", "-o", "frames.pdf", "-o", "frames.gv")},
    "rviz2": {"rviz2": (_COMMAND, "view")},
    "turtlesim": {
        name: (f"turtlesim.{name}:main",) for name in ("turtlesim_node", "turtle_teleop_key", "draw_square", "mimic")
    },
    "demo_nodes_py": {name: (f"demo_nodes_py.{name}:main",) for name in _PYTHON_DEMOS},
    "demo_nodes_cpp": {name: (f"demo_nodes_py.{name}:main",) for name in _CPP_DEMOS},
    "composition": {},
    "rclpy_components": {name: (f"rclpy_components.{name}:main",) for name in _CONTAINERS},
    "rclcpp_components": {name: (f"rclpy_components.{name}:main",) for name in _CONTAINERS},
    "turtle_tf2_py": {
        name: (f"turtle_tf2_py.{name}:main",)
        for name in ("turtle_tf2_broadcaster", "turtle_tf2_listener", "static_turtle_tf2_broadcaster")
    },
    "teleop_twist_keyboard": {"teleop_twist_keyboard": ("teleop_twist_keyboard:main",)},
    "launch_testing": {"launch_test": ("launch_testing.launch_test:main",)},
    "xacro": {"xacro": ("coframe.robots.xacro_program:main",)},
    "coframe": {
        name: (f"coframe.lab.{name}:main",)
        for name in (
            "complete_tf_tree",
            "dynamic_tf_broadcaster",
            "sensor_transform",
            "simulated_lidar",
            "static_tf_broadcaster",
            "tf_listener",
        )
    },
}

# Package -> name of the composable node -> its class.
COMPONENTS: Final[dict[str, dict[str, str]]] = {
    package: {
        f"{package}::Talker": "demo_nodes_py.talker:Talker",
        f"{package}::Listener": "demo_nodes_py.listener:Listener",
    }
    for package in ("composition", "demo_nodes_cpp", "demo_nodes_py")
}


@functools.cache
def names() -> frozenset[str]:
    """Return the names of the ROS packages that coframe provides."""
    folder = ros_folder()
    modules = (each.name for each in folder.iterdir() if each.is_dir()) if folder.is_dir() else ()
    return frozenset(EXECUTABLES) | {name for name in modules if not name.startswith((".", "_"))}


def share(package: str) -> Path:
    """Return the folder of a built-in package. It does not exist if the package has only executables."""
    return (
        Path(__file__).resolve().parents[2] if package == "coframe" else ros_folder() / _FOLDERS.get(package, package)
    )


def executables(package: str) -> dict[str, tuple[str, ...]]:
    """Return the function and arguments of each executable of a package whose module exists."""
    return {name: words for name, words in EXECUTABLES.get(package, {}).items() if _exists(words[0].partition(":")[0])}


def _exists(module: str) -> bool:
    try:
        return importlib.util.find_spec(module) is not None
    except ModuleNotFoundError:
        return False
