# SPDX-License-Identifier: Apache-2.0
"""The executables ``ros2``, ``rviz2`` and ``launch_test``: those of an installed ROS take precedence."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

from coframe._files.regular_files import open_regular

__all__ = ["is_own_script", "launch_test", "real_executable", "ros2", "rviz2"]

_COMMANDS = (
    "action",
    "bag",
    "component",
    "doctor",
    "interface",
    "launch",
    "lifecycle",
    "node",
    "param",
    "pkg",
    "run",
    "service",
    "topic",
)
_ALIASES = {"wtf": "doctor"}
_DOCTOR_OPTIONS = {"--report", "-r", "--report-failed", "-rf", "--include-warnings", "-iw", "--exclude-packages", "-ep"}
_EXTENSIONS = "Packages extend coframe by entry points, such as those of the group coframe.commands."
# Commands of ros2 that coframe does not have, and what to do instead.
_UNSUPPORTED_COMMANDS = {
    "control": "The controllers of ros2_control are C++ programs: they run where ROS is installed.",
    "trace": "Record the graph with ros2 bag record; coframe monitor shows rates, delays and ages of transforms.",
    "plugin": _EXTENSIONS,
    "multicast": "coframe doctor shows whether nodes are discovered.",
    "security": "SECURITY.md of coframe describes what protects the ROS graph.",
    "extension_points": _EXTENSIONS,
    "extensions": _EXTENSIONS,
}
_LAUNCH_TEST = ("launch_testing", "launch_test")
_OWN_SCRIPT = b"coframe.cli.ros2.executable"  # in the executables that `coframe ros2 install` writes
_SCRIPT_SIZE = 10_000  # bytes of an executable to read: those of coframe contain two paths


def ros2() -> None:
    """Run the console script ``ros2``."""
    _run_real("ros2")
    words = sys.argv[1:]
    name = _ALIASES.get(words[0], words[0]) if words else ""
    if name == "daemon":
        print("coframe has no daemon: each command reads the ROS graph itself.")
        return
    if name in _UNSUPPORTED_COMMANDS:
        sys.exit(f"ros2: The command {name} does not exist in coframe. {_UNSUPPORTED_COMMANDS[name]}")
    from coframe.cli import run  # noqa: PLC0415 - not needed where ROS is installed

    if name == "doctor" and not set(words[1:]) - _DOCTOR_OPTIONS:
        # ros2 doctor checks the system and the graph, coframe doctor the transforms.
        words = ["doctor", "--report"]
    elif name == "test":
        name, words = "run", ["run", *_LAUNCH_TEST, *words[1:]]
    run([name, *words[1:]] if words else [], program="ros2", shown=_COMMANDS)


def launch_test() -> None:
    """Run the console script ``launch_test``: the tests of a launched system."""
    _run_real("launch_test")
    from coframe.cli import run  # noqa: PLC0415 - not needed where ROS is installed

    run(["run", *_LAUNCH_TEST, *sys.argv[1:]])


def rviz2() -> None:
    """Run the console script ``rviz2``: open the viewer with RViz's options."""
    _run_real("rviz2")
    parser = argparse.ArgumentParser("rviz2", description="Open coframe's viewer in the browser instead of RViz.")
    parser.add_argument("-d", "--display-config", metavar="FILE", help="a .rviz file")
    parser.add_argument("-f", "--fixed-frame", metavar="FRAME", help="the fixed frame")
    parser.add_argument("-s", "--splash-screen", metavar="FILE", help=argparse.SUPPRESS)
    parser.add_argument("--fullscreen", action="store_true", help=argparse.SUPPRESS)
    given, rest = parser.parse_known_args(_remove_ros_arguments(sys.argv[1:]))
    if rest:
        parser.error(f"unknown arguments: {' '.join(rest)}. coframe view --help shows the options of the viewer.")
    words = ["view"]
    words += ["-d", given.display_config] if given.display_config else []
    words += ["--fixed", given.fixed_frame] if given.fixed_frame else []
    from coframe.cli import run  # noqa: PLC0415 - not needed where ROS is installed

    run(words)


def _run_real(name: str) -> None:
    """Replace this process with the executable of an installed ROS, if there is one."""
    real = real_executable(name)
    if real is None:
        return
    command = [str(real), *sys.argv[1:]]
    if os.name == "posix":
        os.execv(command[0], command)  # noqa: S606 - the executable that the user asked for
    sys.exit(subprocess.run(command, check=False).returncode)  # noqa: S603


def real_executable(name: str) -> Path | None:
    """Return the executable of ROS in AMENT_PREFIX_PATH or PATH; scripts of coframe do not count."""
    folders = [Path(prefix, "bin") for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if prefix]
    folders += [Path(folder) for folder in os.environ.get("PATH", "").split(os.pathsep) if folder]
    names = [name, f"{name}.exe", f"{name}.cmd", f"{name}.bat"] if os.name == "nt" else [name]
    candidates = (folder / each for folder in folders for each in names)
    return next(
        (path for path in candidates if os.access(path, os.X_OK) and path.is_file() and not is_own_script(path)), None
    )


def is_own_script(path: Path) -> bool:
    """Return whether a file is an executable of coframe, or cannot be read."""
    try:
        with open_regular(path) as file:
            content = file.read(_SCRIPT_SIZE)
    except OSError:
        return True  # It cannot be run either.
    return _OWN_SCRIPT in content


def _remove_ros_arguments(words: list[str]) -> list[str]:
    """Return the words without ``--ros-args ... --``, which the viewer does not need."""
    if "--ros-args" not in words:
        return words
    start = words.index("--ros-args")
    rest = words[start:]
    return words[:start] + (_remove_ros_arguments(rest[rest.index("--") + 1 :]) if "--" in rest else [])
