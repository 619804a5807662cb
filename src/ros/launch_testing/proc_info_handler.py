# SPDX-License-Identifier: Apache-2.0
"""Starts and exit codes of the processes of a test."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch_testing.util.proc_lookup import NoMatchingProcessException, resolveProcesses

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from launch.actions.execute_local import ExecuteLocal
    from launch.events.process import ProcessExited, ProcessStarted, RunningProcessEvent

__all__ = ["ActiveProcInfoHandler", "ProcInfoHandler"]


class ProcInfoHandler:
    """The last event of each process: its start, or its end with the exit code.

    ``handler[process]`` is the event of one process, by its action or name.
    """

    def __init__(self) -> None:
        self._by_name: dict[str, RunningProcessEvent] = {}

    def append(self, process_info: ProcessStarted | ProcessExited) -> None:
        """Add an event of a process."""
        self._by_name[process_info.process_name] = process_info

    def __iter__(self) -> Iterator[Any]:
        return iter(list(self._by_name.values()))

    def processes(self) -> list[ExecuteLocal]:
        """Return the actions of the processes."""
        return list(dict.fromkeys(event.action for event in self._by_name.values()))

    def process_names(self) -> list[str]:
        """Return the names of the processes."""
        return list(self._by_name)

    def __getitem__(self, key: str | Action) -> Any:
        if not isinstance(key, Action):
            return self._by_name[key]
        found = [event for event in self._by_name.values() if event.action is key]
        if not found:
            raise KeyError(key)
        return found[-1]


class ActiveProcInfoHandler(ProcInfoHandler):
    """The events of processes that are still running; tests can wait for their start and end."""

    def __init__(self) -> None:
        super().__init__()
        self._changed = threading.Condition(threading.RLock())

    def append(self, process_info: ProcessStarted | ProcessExited) -> None:
        """Add an event of a process, and wake the tests that wait for it."""
        with self._changed:
            super().append(process_info)
            self._changed.notify_all()

    def __iter__(self) -> Iterator[Any]:
        with self._changed:
            return super().__iter__()

    def processes(self) -> list[ExecuteLocal]:
        """Return the actions of the processes."""
        with self._changed:
            return super().processes()

    def process_names(self) -> list[str]:
        """Return the names of the processes."""
        with self._changed:
            return super().process_names()

    def __getitem__(self, key: str | Action) -> Any:
        with self._changed:
            return super().__getitem__(key)

    def assertWaitForStartup(
        self, process: str | ExecuteLocal, cmd_args: Any = None, *, timeout: float | None = 10
    ) -> None:
        """Fail if a process does not start in time.

        Args:
            process: The action, or a part of the name of the process.
            cmd_args: Arguments that the command must contain, or `NO_CMD_ARGS`.
            timeout: Seconds to wait, or None for no limit.

        Raises:
            AssertionError: It has not started after the timeout.
        """
        if not self._wait(lambda _: True, process, cmd_args, timeout):
            raise AssertionError(f"Timed out waiting for process '{_name(process)}' to start")

    def assertWaitForShutdown(
        self, process: str | ExecuteLocal, cmd_args: Any = None, *, timeout: float | None = 10
    ) -> None:
        """Fail if a process does not end in time.

        Args:
            process: The action, or a part of the name of the process.
            cmd_args: Arguments that the command must contain, or `NO_CMD_ARGS`.
            timeout: Seconds to wait, or None for no limit.

        Raises:
            AssertionError: It has not ended after the timeout.
        """
        if not self._wait(lambda event: hasattr(event, "returncode"), process, cmd_args, timeout):
            raise AssertionError(f"Timed out waiting for process '{_name(process)}' to finish")

    def _wait(
        self,
        condition: Callable[[RunningProcessEvent], bool],
        process: str | ExecuteLocal,
        cmd_args: Any,
        timeout: float | None,
    ) -> bool:
        def is_met() -> bool:
            try:
                found = resolveProcesses(self, process=process, cmd_args=cmd_args)
            except NoMatchingProcessException:
                return False
            return all(condition(self[each]) for each in found)

        with self._changed:
            return self._changed.wait_for(is_met, timeout)


def _name(process: str | ExecuteLocal) -> str:
    return process if isinstance(process, str) else str(process.name)
