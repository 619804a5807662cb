# SPDX-License-Identifier: Apache-2.0
"""The output of the processes of a test."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch_testing._matching import output_contains
from launch_testing.util.proc_lookup import NoMatchingProcessException, resolveProcesses

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from launch.actions.execute_local import ExecuteLocal
    from launch.events.process import ProcessIO

__all__ = ["ActiveIoHandler", "IoHandler"]


class IoHandler:
    """The output of all processes, in the order in which it was received.

    ``handler[process]`` is the output of one process, by its action or name.
    """

    def __init__(self) -> None:
        self._sequence: list[ProcessIO] = []
        self._by_name: dict[str, list[ProcessIO]] = {}
        self._actions: dict[str, ExecuteLocal] = {}

    def track(self, process_name: str, action: ExecuteLocal | None = None) -> None:
        """Add a process that has not written anything yet."""
        self._by_name.setdefault(process_name, [])
        if action is not None:
            self._actions[process_name] = action

    def append(self, process_io: ProcessIO) -> None:
        """Add output of a process."""
        self.track(process_io.process_name, process_io.action)
        self._sequence.append(process_io)
        self._by_name[process_io.process_name].append(process_io)

    def __iter__(self) -> Iterator[ProcessIO]:
        return iter(list(self._sequence))

    def processes(self) -> list[ExecuteLocal]:
        """Return the actions of the processes."""
        return list(dict.fromkeys(self._actions.values()))

    def process_names(self) -> list[str]:
        """Return the names of the processes."""
        return list(self._by_name)

    def __getitem__(self, key: str | Action) -> list[ProcessIO]:
        if isinstance(key, Action):
            return [each for name, action in self._actions.items() if action is key for each in self._by_name[name]]
        return list(self._by_name[key])


class ActiveIoHandler(IoHandler):
    """The output of processes that are still running; tests can wait for output."""

    def __init__(self) -> None:
        super().__init__()
        self._changed = threading.Condition(threading.RLock())

    def track(self, process_name: str, action: ExecuteLocal | None = None) -> None:
        """Add a process that has not written anything yet."""
        with self._changed:
            super().track(process_name, action)
            self._changed.notify_all()

    def append(self, process_io: ProcessIO) -> None:
        """Add output of a process, and wake the tests that wait for it."""
        with self._changed:
            super().append(process_io)
            self._changed.notify_all()

    def __iter__(self) -> Iterator[ProcessIO]:
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

    def __getitem__(self, key: str | Action) -> list[ProcessIO]:
        with self._changed:
            return super().__getitem__(key)

    def waitFor(
        self,
        expected_output: Any,
        process: str | ExecuteLocal | None = None,
        cmd_args: Any = None,
        *,
        output_filter: Callable[[str], str] | None = None,
        timeout: float = 10,
        strict_proc_matching: bool = True,
        strip_ansi_escape_sequences: bool = True,
        stream: str = "stderr",
    ) -> bool:
        """Wait until a process has written something, and return whether it has.

        Args:
            expected_output: A text, a compiled regular expression, a list of them, or a function of the output.
            process: The action, a part of the name, or None for all processes.
            cmd_args: Arguments that the command must contain, or `NO_CMD_ARGS`.
            output_filter: Function that returns the part of the output to search in.
            timeout: Seconds to wait.
            strict_proc_matching: Whether several processes that match a name are an error.
            strip_ansi_escape_sequences: Remove colors from the output.
            stream: ``stdout`` or ``stderr``.

        Raises:
            NoMatchingProcessException: Several processes match a name, and `strict_proc_matching` is set.
            ValueError: `output_filter` is not a function, or there is no such stream.
        """

        def is_written() -> bool:
            try:
                found = resolveProcesses(
                    self, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching
                )
            except NoMatchingProcessException:
                return False  # It may start later.
            return output_contains(
                self,
                found,
                expected_output,
                stream,
                output_filter=output_filter,
                strip_ansi_escape_sequences=strip_ansi_escape_sequences,
            )

        with self._changed:
            return self._changed.wait_for(is_written, timeout)

    def assertWaitFor(
        self,
        expected_output: Any,
        process: str | ExecuteLocal | None = None,
        cmd_args: Any = None,
        *,
        output_filter: Callable[[str], str] | None = None,
        timeout: float = 10,
        strict_proc_matching: bool = True,
        strip_ansi_escape_sequences: bool = True,
        stream: str = "stderr",
    ) -> None:
        """Fail if a process does not write the expected output in time. For the arguments, see `waitFor`.

        Raises:
            AssertionError: The output does not appear within the timeout.
        """
        if self.waitFor(
            expected_output,
            process,
            cmd_args,
            output_filter=output_filter,
            timeout=timeout,
            strict_proc_matching=strict_proc_matching,
            strip_ansi_escape_sequences=strip_ansi_escape_sequences,
            stream=stream,
        ):
            return
        # The processes must exist for a message about their output.
        names = resolveProcesses(self, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching)
        listed = ", ".join(str(each.name) for each in names)
        raise AssertionError(
            f"Waiting for output timed out: {expected_output!r} is not in the {stream} of {listed} after {timeout:g} s"
        )
