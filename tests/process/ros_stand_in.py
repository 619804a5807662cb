# SPDX-License-Identifier: Apache-2.0
"""A stand-in for a sourced ROS 2: packages early on the path whose message classes and nodes are not coframe's.

They are a copy of coframe's packages in which every module for messages and DDS and every private member has another
name, so that no class is shared with coframe and nothing private can be used. Where ROS 2 Humble differs in a way that
matters to coframe's own packages, so does the copy: message classes name private modules such as sensor_msgs.msg._imu,
`rclpy.init()` returns None, RMW_IMPLEMENTATION names the middleware, `RCLError` is only in `rclpy._rclpy_pybind11`, the
Python package joint_state_publisher has no names, and tf2_sensor_msgs, tf2_nav_msgs, tf_transformations and
robot_state_publisher cannot be imported.
"""

import os
import re
import shutil
from pathlib import Path

import coframe
from coframe.workspace import ros_folders

THEIRS = "theirs"  # the package with the copies of coframe.messages and coframe.wire
_OTHER = ("tf2_geometry_msgs", "sensor_msgs_py")
_CHECK = re.compile(r"^from coframe\.workspace import ros_side\n|^ros_side\.check\(.*\)\n", re.MULTILINE)
_MODULES = re.compile(r"\bcoframe\.(messages|wire)\b")
_CLASS_MODULE = 'cls.__module__ = ".".join(cls.ROS_TYPE.split("/")[:-1])'
_PRIVATE = "_Coframe__"
_RCL_ERROR = re.compile(r"\bRCLError\b")


def make(folder: Path) -> None:
    """Write the packages of the stand-in into a folder."""
    library = Path(coframe.__file__).parent
    for part in ("messages", "wire"):
        shutil.copytree(library / part, folder / THEIRS / part, ignore=shutil.ignore_patterns("__pycache__"))
    for package in (*ros_folders.PACKAGES, *_OTHER):
        shutil.copytree(
            ros_folders.ros_folder() / package, folder / package, ignore=shutil.ignore_patterns("__pycache__")
        )
    for file in folder.rglob("*.py"):
        text = _MODULES.sub(rf"{THEIRS}.\1", _CHECK.sub("", file.read_text())).replace(_PRIVATE, "_Theirs__")
        if file.is_relative_to(folder / "rclpy"):
            text = _RCL_ERROR.sub("_RCLError", text)
        file.write_text(text)
    message = folder / THEIRS / "messages" / "message.py"
    assert _CLASS_MODULE in message.read_text()
    message.write_text(message.read_text().replace(_CLASS_MODULE, f"{_CLASS_MODULE} + '._private'"))
    (folder / THEIRS / "__init__.py").touch()
    _append(folder / "rclpy" / "_rclpy_pybind11.py", "RCLError = _RCLError")
    _append(
        folder / "rclpy" / "__init__.py",
        "_init = init\ndef init(**options):\n    _init(**options)\n",
    )
    _append(
        folder / "rclpy" / "utilities.py",
        "import os\n"
        "def get_rmw_implementation_identifier():\n"
        "    return os.environ.get('RMW_IMPLEMENTATION', 'rmw_cyclonedds_cpp')\n",
    )
    (folder / "joint_state_publisher").mkdir()
    (folder / "joint_state_publisher" / "__init__.py").touch()


def environment(folder: Path) -> dict[str, str]:
    """Return the environment of a process in which the stand-in is sourced."""
    path = os.pathsep.join(filter(None, [str(folder), os.environ.get("PYTHONPATH")]))
    return {**os.environ, "PYTHONPATH": path, "ROS_DISTRO": "humble"}


def _append(file: Path, text: str) -> None:
    file.write_text(f"{file.read_text()}\n\n{text}\n")
