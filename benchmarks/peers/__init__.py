# SPDX-License-Identifier: Apache-2.0
"""Finds the peers, and says what to install if one is missing."""

import importlib
import os
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from scripts.ros_wheels.environments import DISTROS, Environment

from benchmarks.measuring import MissingPeerError
from benchmarks.process import OWN_PYTHON, ROOT, TIME_LIMIT_S, Program, Python, can_import

DEBIAN_PYTHON: Python = ("/usr/bin/python3", "-E")
"""Ignores PYTHONPATH, which is meant for another Python."""


@dataclass(frozen=True)
class Tf2:
    """Another implementation of tf2.

    Attributes:
        name: Name of the provider.
        python: Returns the Python that has it and the given packages; raises a MissingPeerError if there is none.
    """

    name: str
    python: Callable[..., Python]


def _debian(*also: str) -> Python:
    if not can_import(DEBIAN_PYTHON, "tf2_py", "genpy", *also):
        raise MissingPeerError("apt-get install python3-tf2-ros python3-tf2-sensor-msgs python3-pykdl")
    return DEBIAN_PYTHON


def sourced(*modules: str) -> Python:
    """Return the Python of the sourced ROS 2 if it has rclpy and these modules."""
    python = (shutil.which("python3") or "python3",)
    if "ROS_DISTRO" not in os.environ or not can_import(python, "rclpy", *modules):
        raise MissingPeerError("source a ROS 2 with tf2-ros and tf2-sensor-msgs")
    return python


def _ros2(*also: str) -> Python:
    return sourced("tf2_py", *also)


DEBIAN = Tf2("Debian's tf2", _debian)
"""ROS 1's C++ core and its Python binding."""
ROS2 = Tf2("ROS 2's tf2", _ros2)
"""The tf2 of the sourced ROS 2."""


class RosWheels:
    """ROS 2's rclpy and Fast DDS, which `make test-ros-wheels` installs from wheels."""

    name = "ROS 2 Jazzy's rclpy on Fast DDS, from wheels"

    def program(self, *arguments: str, time_limit: float = TIME_LIMIT_S) -> Program:
        """Return a program that runs there; raise a MissingPeerError if it is not installed."""
        environment = Environment(DISTROS["jazzy"], ROOT / "build/ros_wheels")
        if not environment.is_complete:
            raise MissingPeerError("make test-ros-wheels")
        # Programs that run in coframe's Python are started from there.
        variables = {**environment.variables(), "COFRAME_WIRE": "fastdds"}
        return Program(*arguments, python=(str(environment.python),), environment=variables, time_limit=time_limit)


ROS_WHEELS = RosWheels()


def package(name: str) -> Any:
    """Import a package from PyPI."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise MissingPeerError("run make bench with access to a package index") from None


def own_python(name: str) -> Python:
    """Return this Python if it has a package from PyPI."""
    package(name)
    return OWN_PYTHON
