"""A node as a program: it runs until it is ended from outside, and what is wrong is one sentence."""

import sys
from collections.abc import Callable

import rclpy
from rclpy.exceptions import NameValidationException, ParameterException, RCLError
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args

__all__ = ["program", "spin_until_ended"]


def spin_until_ended(make_node: Callable[[], Node], args: list[str], domain_id: int | None) -> None:
    """Run a node until it is ended from outside.

    Args:
        make_node: Makes it.
        args: A command line; what follows `--ros-args` is the node's.
        domain_id: DDS domain; None: as the environment says.
    """
    try:
        with rclpy.init(args=args, domain_id=domain_id):
            rclpy.spin(make_node())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


def program(name: str, args: list[str] | None, run: Callable[[list[str], list[str]], None]) -> None:
    """A console script.

    Args:
        name: The program's.
        args: What follows its name on the command line; None: as this process was started.
        run: Gets the whole command line, and what of it is not ROS's, without the name.
    """
    words = [name, *(sys.argv[1:] if args is None else args)]
    try:
        run(words, remove_ros_args(words)[1:])
    except (NameValidationException, ParameterException, RCLError, ValueError) as error:
        hint = getattr(error, "hint", "")
        sys.exit(f"{name}: {error}" + (f"\n  {hint}" if hint else ""))
