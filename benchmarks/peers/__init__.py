"""Where the peers are, and what to install where one is not."""

import importlib
import os
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from benchmarks.measuring import MissingPeerError
from benchmarks.process import OWN_PYTHON, Python, can_import

DEBIAN_PYTHON: Python = ("/usr/bin/python3", "-E")
"""Whatever PYTHONPATH names is for another Python."""


@dataclass(frozen=True)
class Tf2:
    """A tf2 that is not ours.

    Attributes:
        name: Whose it is.
        python: The Python that has it, and these packages, too; a MissingPeerError if there is none.
    """

    name: str
    python: Callable[..., Python]


def _debian(*also: str) -> Python:
    if not can_import(DEBIAN_PYTHON, "tf2_py", "genpy", *also):
        raise MissingPeerError("apt-get install python3-tf2-ros python3-tf2-sensor-msgs python3-pykdl")
    return DEBIAN_PYTHON


def _ros2(*also: str) -> Python:
    python = (shutil.which("python3") or "python3",)
    if "ROS_DISTRO" not in os.environ or not can_import(python, "rclpy", "tf2_py", *also):
        raise MissingPeerError("source a ROS 2 with tf2-ros and tf2-sensor-msgs")
    return python


DEBIAN = Tf2("Debian's tf2", _debian)
"""ROS 1's C++ core and its Python binding."""
ROS2 = Tf2("ROS 2's tf2", _ros2)
"""Of a ROS 2 that has been sourced."""


def package(name: str) -> Any:
    """A package from PyPI in this Python."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise MissingPeerError("make bench installs it where there is a package index") from None


def own_python(name: str) -> Python:
    """This Python, where it has a package from PyPI."""
    package(name)
    return OWN_PYTHON
