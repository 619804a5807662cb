"""Starts the lab's nodes, each as a process of its own, and ends them again."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import TracebackType

    from typing_extensions import Self

__all__ = ["COMPLETE_LAB", "DESCRIBED_LAB", "FailedNode", "Launcher", "NodeCommand"]

# How long a node may take to end after it was asked to.
END_TIMEOUT = 5.0


class NodeCommand(NamedTuple):
    """A node of the lab and its ROS arguments.

    Attributes:
        name: What it is called here.
        arguments: What follows ``--ros-args``.
        module: Its module in ``coframe.lab``; "": that of its name.
    """

    name: str
    arguments: tuple[str, ...] = ()
    module: str = ""


class FailedNode(NamedTuple):
    """A node that ended by itself, and the last lines it wrote."""

    name: str
    exit_code: int
    last_lines: str


# The whole lab. The arm comes from the dynamic broadcaster alone: with two sources it would flicker.
COMPLETE_LAB = (
    NodeCommand("complete_tf_tree", ("-p", "publish_arm:=false")),
    NodeCommand("dynamic_tf_broadcaster"),
    NodeCommand("simulated_lidar"),
    NodeCommand("sensor_transform"),
)

# The same, with arm, sensors and gripper from two_link_arm.urdf.xacro.
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
    """Runs nodes while the ``with`` block runs; what they write goes to files in a temporary folder.

    Args:
        commands: The nodes.
        domain: Their ROS domain; None leaves it to ROS_DOMAIN_ID.
    """

    def __init__(self, commands: tuple[NodeCommand, ...] = COMPLETE_LAB, *, domain: int | None = None) -> None:
        self._commands = commands
        self._environment = {**os.environ} if domain is None else {**os.environ, "ROS_DOMAIN_ID": str(domain)}
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        self._folder = tempfile.TemporaryDirectory(prefix="coframe-lab-", ignore_cleanup_errors=True)

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
        """The nodes, in the order in which they were started."""
        return list(self._processes)

    def failed(self) -> FailedNode | None:
        """The first node that has ended by itself, if any."""
        return next(self.ended(), None)

    def ended(self) -> Iterator[FailedNode]:
        """The nodes that have ended by themselves."""
        for name, process in self._processes.items():
            code = process.poll()
            if code is not None:
                lines = self._log(name).read_text(errors="replace").splitlines()
                yield FailedNode(name, code, "\n".join(lines[-10:]))

    def stop(self) -> None:
        """Asks all nodes to end, and insists where that takes too long."""
        for process in self._processes.values():
            if process.poll() is None:
                process.terminate()
        deadline = time.monotonic() + END_TIMEOUT
        for process in self._processes.values():
            try:
                process.wait(max(0.0, deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        for process in self._processes.values():
            if process.stdin:
                process.stdin.close()
        self._processes.clear()
        self._folder.cleanup()

    def _log(self, name: str) -> Path:
        return Path(self._folder.name) / f"{name}.log"

    def _start(self, command: NodeCommand) -> subprocess.Popen[bytes]:
        module = f"coframe.lab.{command.module or command.name}"
        arguments = ("--ros-args", *command.arguments) if command.arguments else ()
        with self._log(command.name).open("wb") as log:
            return subprocess.Popen(  # noqa: S603 - our own modules in our own Python
                [sys.executable, "-m", "coframe.lab.run_node", module, *arguments],
                stdin=subprocess.PIPE,
                stdout=log,
                stderr=log,
                env=self._environment,
                # Ctrl-C is for the launcher, which ends its nodes in order.
                start_new_session=True,
            )
