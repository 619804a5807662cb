# SPDX-License-Identifier: Apache-2.0
"""Diagnostic tasks, and the updater that runs them and publishes their results."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from diagnostic_updater._diagnostic_status_wrapper import DiagnosticStatusWrapper

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.node import Node

    TaskFunction = Callable[[DiagnosticStatusWrapper], DiagnosticStatusWrapper]

__all__ = ["CompositeDiagnosticTask", "DiagnosticTask", "DiagnosticTaskVector", "FunctionDiagnosticTask", "Updater"]

_PERIOD = "diagnostic_updater.period"
_USE_FQN = "diagnostic_updater.use_fqn"


class DiagnosticTask:
    """Base class of tasks. Subclasses implement `run`.

    Args:
        name: Name of the status.
    """

    def __init__(self, name: str) -> None:
        self.name = name

    def getName(self) -> str:
        """Return the name of the status."""
        return self.name

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Fill in a status and return it."""
        raise NotImplementedError(f"{type(self).__name__} does not implement run()")


class FunctionDiagnosticTask(DiagnosticTask):
    """A task that calls a function.

    Args:
        name: Name of the status.
        fn: Function that fills in a status and returns it.
    """

    def __init__(self, name: str, fn: TaskFunction) -> None:
        super().__init__(name)
        self.fn = fn

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Call the function."""
        return self.fn(stat)


class CompositeDiagnosticTask(DiagnosticTask):
    """A task that combines other tasks into one status, with all values and the merged summaries.

    Args:
        name: Name of the status.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.tasks: list[DiagnosticTask] = []

    def addTask(self, t: DiagnosticTask) -> None:
        """Add a task."""
        self.tasks.append(t)

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Run all tasks, each with the summary that was passed in."""
        original, combined = DiagnosticStatusWrapper(), DiagnosticStatusWrapper()
        original.summary(stat)
        for task in self.tasks:
            stat.summary(original)
            stat = task.run(stat)
            combined.mergeSummary(stat)
        stat.summary(combined)
        return stat


class DiagnosticTaskVector:
    """A list of tasks.

    Attributes:
        tasks: The tasks, in the order in which they were added.
        lock: Lock that protects the list.
    """

    class DiagnosticTaskInternal:
        """The name and the function of a task."""

        def __init__(self, name: str, fn: TaskFunction) -> None:
            self.name = name
            self.fn = fn

        def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
            """Set the name of a status and call the function with it."""
            stat.name = self.name
            return self.fn(stat)

    def __init__(self) -> None:
        self.tasks: list[DiagnosticTaskVector.DiagnosticTaskInternal] = []
        self.lock = threading.Lock()

    def addedTaskCallback(self, task: DiagnosticTaskVector.DiagnosticTaskInternal) -> None:
        """Handle a new task. Subclasses may override this method."""

    def add(self, *args: Any) -> None:
        """Add a task: `add(task)` or `add(name, function)`."""
        name, function = (args[0].getName(), args[0].run) if len(args) == 1 else args
        task = DiagnosticTaskVector.DiagnosticTaskInternal(name, function)
        with self.lock:
            self.tasks.append(task)
            self.addedTaskCallback(task)

    def removeByName(self, name: str) -> bool:
        """Remove the first task with a name, and return whether there was one."""
        with self.lock:
            found = next((task for task in self.tasks if task.name == name), None)
            if found is not None:
                self.tasks.remove(found)
        return found is not None


class Updater(DiagnosticTaskVector):
    """A list of tasks that are run periodically, and whose results are published on `/diagnostics`.

    The parameter `diagnostic_updater.period` overrides the period. `diagnostic_updater.use_fqn` sets whether the names
    of statuses begin with the node's name including its namespace.

    Args:
        node: Node that publishes.
        period: Period in seconds.

    Attributes:
        verbose: Whether to log each status that is not OK.
        hwid: Identifier of the hardware.
    """

    def __init__(self, node: Node, period: float = 1.0) -> None:
        super().__init__()
        self.node = node
        self.publisher = node.create_publisher(DiagnosticArray, "/diagnostics", 1)
        self.clock = node.get_clock()
        self.verbose = False
        self.hwid = ""
        self.warn_nohwid_done = False
        self.__period = float(_parameter(node, _PERIOD, float(period)))
        name = node.get_fully_qualified_name() if _parameter(node, _USE_FQN, False) else node.get_name()
        self.__prefix = f"{name}: "
        self.timer = node.create_timer(self.__period, self.update)

    @property
    def period(self) -> float:
        """The period in seconds."""
        return self.__period

    @period.setter
    def period(self, new_period: float) -> None:
        self.__period = new_period
        self.timer.timer_period_ns = round(new_period * 1e9)
        self.timer.reset()

    def update(self) -> None:
        """Run all tasks and publish their results."""
        with self.lock:  # No task is added in the meantime.
            statuses = [task.run(self.__new_status(task.name)) for task in self.tasks]
        problems = [status for status in statuses if status.level != DiagnosticStatus.OK]
        if self.verbose:
            for status in problems:
                self.node.get_logger().warning(
                    f"Non-zero diagnostic status. Name: {status.name}, status {status.level[0]}: {status.message}"
                )
        if not (self.hwid or problems or self.warn_nohwid_done):
            self.node.get_logger().warning(
                "diagnostic_updater: No HW_ID was set. Call setHardwareID() with the serial number of the hardware, or "
                "with 'none' if there is no hardware."
            )
            self.warn_nohwid_done = True
        self.publish(statuses)

    def force_update(self) -> None:
        """Run all tasks and publish their results now."""
        self.update()

    def broadcast(self, lvl: bytes, msg: str) -> None:
        """Publish a level and a message for all tasks.

        Args:
            lvl: Level, such as `DiagnosticStatus.ERROR`.
            msg: Message.
        """
        statuses = []
        for task in self.tasks:
            status = DiagnosticStatusWrapper(name=task.name)
            status.summary(lvl, msg)
            statuses.append(status)
        self.publish(statuses)

    def setHardwareID(self, hwid: str) -> None:
        """Set the identifier of the hardware, which is part of each status."""
        self.hwid = hwid

    def publish(self, msg: DiagnosticStatus | Sequence[DiagnosticStatus]) -> None:
        """Publish one or several statuses, to whose names the name of the node is added."""
        statuses = [msg] if isinstance(msg, DiagnosticStatus) else list(msg)
        for status in statuses:
            status.name = f"{self.__prefix}{status.name}"
        message = DiagnosticArray(status=statuses)
        message.header.stamp = self.clock.now().to_msg()
        self.publisher.publish(message)

    def addedTaskCallback(self, task: DiagnosticTaskVector.DiagnosticTaskInternal) -> None:
        """Publish that a task was added."""
        status = DiagnosticStatusWrapper(name=task.name)
        status.summary(DiagnosticStatus.OK, "Node starting up")
        self.publish(status)

    def __new_status(self, name: str) -> DiagnosticStatusWrapper:
        return DiagnosticStatusWrapper(
            level=DiagnosticStatus.ERROR, name=name, message="No message was set", hardware_id=self.hwid
        )


def _parameter(node: Node, name: str, default: Any) -> Any:
    if not node.has_parameter(name):
        node.declare_parameter(name, default)
    return node.get_parameter(name).value
