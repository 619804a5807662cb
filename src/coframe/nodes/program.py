# SPDX-License-Identifier: Apache-2.0
"""Entry points of nodes as programs, which run until shutdown and report errors as a message."""

from __future__ import annotations

import contextlib
import sys
from typing import TYPE_CHECKING, Final

import rclpy
from coframe.errors import CoframeError

# Only coframe's rclpy.exceptions has these exceptions.
from rclpy._rclpy_pybind11 import RCLError, UnknownROSArgsError
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.utilities import remove_ros_args

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rclpy.node import Node

__all__ = ["NODE_ERRORS", "initialize_rclpy", "program", "spin_until_shutdown"]

# The exceptions for invalid ROS arguments, names and parameters of a node.
NODE_ERRORS: Final = (NameValidationException, ParameterException, RCLError, UnknownROSArgsError)


@contextlib.contextmanager
def initialize_rclpy(args: list[str], domain_id: int | None) -> Iterator[None]:
    """Initialize rclpy for the duration of the context. `rclpy.init` is a context manager only since Jazzy.

    Args:
        args: Command line with `--ros-args`.
        domain_id: ROS domain. None: ROS_DOMAIN_ID or 0.
    """
    rclpy.init(args=args, domain_id=domain_id)
    try:
        yield
    finally:
        rclpy.try_shutdown()


def spin_until_shutdown(make_node: Callable[[], Node], args: list[str], domain_id: int | None) -> None:
    """Run a node until shutdown.

    Args:
        make_node: Function that creates the node.
        args: Command line with `--ros-args`.
        domain_id: ROS domain. None: ROS_DOMAIN_ID or 0.
    """
    try:
        with initialize_rclpy(args, domain_id):
            rclpy.spin(make_node())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


def program(name: str, args: list[str] | None, run: Callable[[list[str], list[str]], None]) -> None:
    """Run a console script and report its errors.

    Args:
        name: Name of the program.
        args: Command line without the name, or None for the command line of the process.
        run: Function that is called with the command line, and with the arguments that are not ROS arguments.
    """
    words = [name, *(sys.argv[1:] if args is None else args)]
    try:
        run(words, remove_ros_args(words)[1:])
    except (*NODE_ERRORS, CoframeError, ValueError) as error:
        hint = getattr(error, "hint", "")
        sys.exit(f"{name}: {error}" + (f"\n  {hint}" if hint else ""))
