# SPDX-License-Identifier: Apache-2.0
"""Start and stop the nodes of the lab, each in its own process."""

from __future__ import annotations

import subprocess
import time
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe._files.temporary_folders import temporary_folder
from coframe._process.own_group import own_group
from coframe._process.python_children import python_command, python_environment

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import TracebackType

    from typing_extensions import Self

__all__ = ["COMPLETE_LAB", "DESCRIBED_LAB", "FailedNode", "Launcher", "NodeCommand"]

STOP_TIMEOUT = 5.0  # seconds until SIGKILL


class NodeCommand(NamedTuple):
    """The command that starts a node of the lab.

    Attributes:
        name: The name of the process.
        arguments: The arguments after ``--ros-args``.
        module: The module in ``coframe.lab``. If "", it is `name`.
    """

    name: str
    arguments: tuple[str, ...] = ()
    module: str = ""


class FailedNode(NamedTuple):
    """A node that stopped by itself, with its exit code and the last lines of its output."""

    name: str
    exit_code: int
    last_lines: str


# The complete lab. Only the dynamic broadcaster publishes the arm, because two sources would make it flicker.
COMPLETE_LAB = (
    NodeCommand("complete_tf_tree", ("-p", "publish_arm:=false")),
    NodeCommand("dynamic_tf_broadcaster"),
    NodeCommand("simulated_lidar"),
    NodeCommand("sensor_transform"),
)

# The complete lab, with arm, sensors and gripper from two_link_arm.urdf.xacro.
DESCRIBED_LAB = (
    NodeCommand(
        "complete_tf_tree",
        ("-p", "publish_arm:=false", "-p", "publish_mounts:=false", "-p", "publish_gripper:=false"),
    ),
    NodeCommand("dynamic_tf_broadcaster", ("-p", "publish_joint_states:=true")),
    NodeCommand("robot_state_publisher", ("-p", "ignore_timestamp:=true")),
    NodeCommand("simulated_lidar"),
    NodeCommand("sensor_transform"),
)


class Launcher:
    """A context manager that runs nodes. Their output goes to files in a temporary folder.

    Args:
        commands: The nodes to start.
        domain: The ROS domain of the nodes. If None, it is ROS_DOMAIN_ID.
    """

    def __init__(self, commands: tuple[NodeCommand, ...] = COMPLETE_LAB, *, domain: int | None = None) -> None:
        self._commands = commands
        self._environment = python_environment()
        if domain is not None:
            self._environment["ROS_DOMAIN_ID"] = str(domain)
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        self._folder = temporary_folder("coframe-lab-")

    def __enter__(self) -> Self:
        for command in self._commands:
            self._processes[command.name] = self._start(command)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.stop()

    @property
    def names(self) -> list[str]:
        """The names of the nodes, in the order in which they were started."""
        return list(self._processes)

    def failed(self) -> FailedNode | None:
        """Return the first node that has stopped by itself, or None if all are running."""
        return next(self.ended(), None)

    def ended(self) -> Iterator[FailedNode]:
        """Yield the nodes that have stopped by themselves."""
        for name, process in self._processes.items():
            code = process.poll()
            if code is not None:
                lines = self._log(name).read_text(encoding="utf-8", errors="replace").splitlines()
                yield FailedNode(name, code, "\n".join(lines[-10:]))

    def stop(self) -> None:
        """Stop all nodes by closing their standard input, and with SIGKILL after a timeout."""
        for process in self._processes.values():
            if process.stdin:
                process.stdin.close()
        deadline = time.monotonic() + STOP_TIMEOUT
        for process in self._processes.values():
            try:
                process.wait(max(0.0, deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self._processes.clear()
        self._folder.cleanup()

    def _log(self, name: str) -> Path:
        return Path(self._folder.name) / f"{name}.log"

    def _start(self, command: NodeCommand) -> subprocess.Popen[bytes]:
        module = f"coframe.lab.{command.module or command.name}"
        arguments = ("--ros-args", *command.arguments) if command.arguments else ()
        with self._log(command.name).open("wb") as log:
            return subprocess.Popen(  # noqa: S603 - runs only modules of coframe
                python_command("coframe.lab.run_node", module, *arguments),
                stdin=subprocess.PIPE,
                stdout=log,
                stderr=log,
                env=self._environment,
                **own_group(),  # Ctrl-C must reach only the launcher, which then stops the nodes.
            )
