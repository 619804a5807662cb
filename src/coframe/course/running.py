# SPDX-License-Identifier: Apache-2.0
"""Run the programs of a folder as processes, with their output prefixed by their names."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe._process.own_group import own_group
from coframe._process.python_children import python_command, python_environment
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

__all__ = [
    "COMPLETE_TREE_FILES",
    "EXACT_FIELDS",
    "NODE_FILES",
    "NamedCommand",
    "module_program",
    "programs_of",
    "running",
    "simulation",
]

NODE_FILES = ("static_tf_broadcaster.py", "dynamic_tf_broadcaster.py", "tf_listener.py", "sensor_transform.py")
COMPLETE_TREE_FILES = ("complete_tf_tree.py", "tf_listener.py", "sensor_transform.py")
# As in ROS 2 Humble, an integer in a field for a float is an error, whichever distribution the environment names:
# a program has the same grade everywhere.
EXACT_FIELDS = {"ROS_PYTHON_CHECK_FIELDS": "1"}
_STOP_TIMEOUT = 3.0  # seconds between SIGINT and SIGKILL


class NamedCommand(NamedTuple):
    """A program: its name, and the command that starts it."""

    name: str
    command: tuple[str, ...]


def module_program(name: str, module: str, *arguments: str) -> NamedCommand:
    """Return a program that is a module of coframe."""
    return NamedCommand(name, tuple(python_command(module, *arguments)))


_LIDAR = ("--ros-args", "-p", "fixed_frame:=base_link")
_JOINTS = module_program("simulated joints", "coframe.course._simulated_joints")
# Only the mount of the gripper, on which the lidar is then mounted.
_GRIPPER = module_program(
    "gripper",
    "coframe.lab.complete_tf_tree",
    *("--ros-args", "-r", "__node:=gripper", "-p", "publish_world:=false", "-p", "publish_base:=false"),
    *("-p", "publish_arm:=false", "-p", "publish_mounts:=false"),
)


def simulation(*, joints: bool = False, gripper: bool = False) -> list[NamedCommand]:
    """Return the programs that simulate the robot: a lidar, and if wanted the joint states.

    Args:
        joints: Whether joint states are published. Without them, the arm of the student's node simulates its motion.
        gripper: Whether the lidar is mounted on the moving gripper instead of the base.
    """
    frame = ("-p", "frame:=gripper_link") if gripper else ()
    lidar = module_program("simulated lidar", "coframe.lab.simulated_lidar", *_LIDAR, *frame)
    return [*([_JOINTS] if joints else []), *([_GRIPPER] if gripper else []), lidar]


def programs_of(folder: Path, names: Sequence[str]) -> list[NamedCommand]:
    """Return the named programs that exist in a folder.

    Raises:
        CourseError: It contains none of them.
    """
    found = [
        NamedCommand(Path(name).stem, (sys.executable, str(folder / name)))
        for name in names
        if (folder / name).is_file()
    ]
    if not found:
        raise CourseError(
            f"{folder} contains none of the files {', '.join(names)}.",
            hint="Create a folder with coframe lab new, or give the path of yours.",
        )
    return found


@contextlib.contextmanager
def running(programs: Sequence[NamedCommand], write: Callable[[str, str], None]) -> Iterator[None]:
    """Run programs during the block.

    Args:
        programs: The commands to start, each with the name for its output.
        write: Called from other threads with the name of a program and a line of its output, or a status message.
    """
    processes: list[tuple[NamedCommand, subprocess.Popen[str]]] = []
    threads = []
    stopping = threading.Event()
    try:
        for program in programs:
            process = subprocess.Popen(  # noqa: S603 - the user's own programs
                program.command,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                encoding="utf-8",
                errors="replace",
                env=python_environment() | EXACT_FIELDS | {"PYTHONUNBUFFERED": "1", "PYTHONIOENCODING": "utf-8"},
                **own_group(),  # Only this process receives Ctrl-C; it stops the others.
            )
            processes.append((program, process))
            thread = threading.Thread(
                target=_forward_output, args=(program.name, process, write, stopping), daemon=True
            )
            thread.start()
            threads.append(thread)
        yield
    finally:
        stopping.set()
        _stop([process for _, process in processes])
        for thread in threads:
            thread.join(1.0)


def _forward_output(
    name: str, process: subprocess.Popen[str], write: Callable[[str, str], None], stopping: threading.Event
) -> None:
    assert process.stdout is not None
    with process.stdout as output:
        for line in output:
            write(name, line.rstrip("\n"))
    code = process.wait()
    if not stopping.is_set():
        write(name, f"ended with exit code {code}")


def _stop(processes: list[subprocess.Popen[str]]) -> None:
    for process in processes:
        if process.poll() is None:
            process.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)
    deadline = time.monotonic() + _STOP_TIMEOUT
    for process in processes:
        try:
            process.wait(max(0.0, deadline - time.monotonic()))
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
