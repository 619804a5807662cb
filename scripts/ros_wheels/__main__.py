# SPDX-License-Identifier: Apache-2.0
"""Test coframe beside ROS 2 from wheels: its own rclpy, message classes and Fast DDS, without an installation of ROS.

    python -m scripts.ros_wheels                      all installed middlewares, Jazzy and Kilted, both directions
    python -m scripts.ros_wheels --wire dds --distro jazzy
    python -m scripts.ros_wheels --quick           without what coframe must be compiled for: coframe.ros2 and the lab
    python -m scripts.ros_wheels --write              also write the table to docs/reference/differences.md

Prints a table, and grades the solution of the lab on Kilted. Requires Linux on x86-64, Python 3.10 to 3.13 with its
headers, and a C++ compiler; the first time, pip downloads the wheels into build/ros_wheels. There are no wheels of
rmw_zenoh_cpp and rmw_cyclonedds_cpp. On a machine with a complete ROS 2, `make test-ros` runs programs with all its
packages.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

from scripts.ros_wheels.environments import DISTROS, ROOT, Environment
from scripts.ros_wheels.matrix import FAILED, Cell, Key, run_inside, run_pair
from scripts.ros_wheels.table import render, write

from coframe.wire import selection

PROTOCOL = "rtps"  # what the Fast DDS of the wheels sends


def main() -> int:
    """Run what the command line asks for. Return the exit code."""
    summary = (__doc__ or "").splitlines()[0]
    parser = argparse.ArgumentParser(prog="ros_wheels", description=summary)
    parser.add_argument(
        "--folder", type=Path, default=ROOT / "build/ros_wheels", help="where the environments are kept"
    )
    parser.add_argument("--distro", action="append", choices=list(DISTROS), help="only this distribution; repeatable")
    parser.add_argument("--wire", action="append", help="only this middleware; repeatable")
    parser.add_argument("--write", action="store_true", help="write the table to the documentation")
    parser.add_argument("--quick", action="store_true", help="skip what is run with coframe inside ROS 2")
    arguments = parser.parse_args()
    available = [row.wire for row in selection.middlewares() if row.protocol == PROTOCOL and _is_available(row)]
    wires = [wire for wire in arguments.wire or available if wire in available]
    environments = [Environment(DISTROS[name], arguments.folder) for name in arguments.distro or DISTROS]
    for environment in environments:
        environment.create()
    cells: dict[Key, Cell] = {}
    for wire in wires:
        for environment in environments:
            for coframe_uses in (True, False):
                for key, cell in run_pair(wire, environment, coframe_uses=coframe_uses):
                    _report(cells, key, cell)
    is_graded = True
    if not arguments.quick:
        wheel = _build_wheel(arguments.folder)
        for environment in environments:
            environment.install(wheel)
            if "dds" in wires:
                _report(cells, *run_inside(environment))
        is_graded = all(_grade(each) for each in environments if each.distro.name == "kilted")
    table = render(cells)
    print(f"\n{table}")
    if arguments.write:
        write(table)
    return 0 if is_graded and all(cell.state != FAILED for cell in cells.values()) else 1


def _report(cells: dict[Key, Cell], key: Key, cell: Cell) -> None:
    cells[key] = cell
    who = "coframe uses" if key.coframe_uses else "coframe provides"
    print(f"{key.wire}, {key.distro}, {who}: {key.row}: {cell.state} {cell.detail}".rstrip(), flush=True)


def _is_available(row: selection.MiddlewareRow) -> bool:
    return row.load().is_available(os.environ)


def _build_wheel(folder: Path) -> Path:
    """Build a wheel of this checkout."""
    target = folder / "dist"
    for old in target.glob("coframe-*.whl"):
        old.unlink()
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(target), str(ROOT)]
    subprocess.run(command, check=True)
    (wheel,) = target.glob("coframe-*.whl")
    return wheel


def _grade(environment: Environment) -> bool:
    """Grade the solution of the lab with the nodes of the environment."""
    command = [
        str(environment.python),
        "-m",
        "pytest",
        "tests/course/test_sourced_ros.py",
        "-v",
        "-p",
        "no:cacheprovider",
    ]
    variables = {**environment.variables(), "COFRAME_TEST_ROS": "1"}
    return subprocess.run(command, cwd=ROOT, env=variables, check=False).returncode == 0


if __name__ == "__main__":
    sys.exit(main())
