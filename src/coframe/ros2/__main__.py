# SPDX-License-Identifier: Apache-2.0
"""Run an unchanged program of a sourced ROS 2 with coframe's tf2: ``python -m coframe.ros2 node.py``."""

from __future__ import annotations

import argparse
import runpy
import sys
from pathlib import Path

from coframe.ros2 import _replacement
from coframe.workspace import ros_side


def main() -> None:
    """Run the program that the command line names."""
    parser = argparse.ArgumentParser(
        prog="python -m coframe.ros2",
        description="Run a program of a sourced ROS 2 with coframe's tf2_ros and tf2_py instead of its own.",
        epilog="Example: python -m coframe.ros2 node.py --ros-args -r /tf:=/robot1/tf",
    )
    parser.add_argument(
        "--wire",
        choices=("native", "rclpy"),
        help="How listeners receive transforms: by coframe (native), or through the ROS node (rclpy). "
        "Default: COFRAME_ROS2_WIRE, or native where coframe can use the middleware.",
    )
    parser.add_argument("-m", dest="module", action="store_true", help="PROGRAM is the name of a module.")
    parser.add_argument("program", metavar="PROGRAM", help="The program's file, or with -m its module.")
    parser.add_argument("arguments", nargs=argparse.REMAINDER, help="The arguments of the program.")
    options = parser.parse_args()
    if options.wire:
        ros_side.choose_listener_wire(options.wire)
    if not options.module and not Path(options.program).is_file():
        parser.error(f"there is no file {options.program}; for a module, use -m")
    _replacement.install()
    sys.argv = [options.program, *options.arguments]
    if options.module:
        runpy.run_module(options.program, run_name="__main__", alter_sys=True)
    else:
        sys.path[0] = str(Path(options.program).resolve().parent)
        runpy.run_path(options.program, run_name="__main__")


if __name__ == "__main__":
    main()
