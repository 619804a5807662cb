# SPDX-License-Identifier: Apache-2.0
"""A process that a test starts in the running launch service."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from launch import LaunchDescription
from launch.events import matches_action
from launch.events.process import ShutdownProcess
from launch_testing._matching import output_contains
from launch_testing.util.proc_lookup import NoMatchingProcessException, resolveProcesses

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from launch import LaunchService
    from launch.actions import ExecuteProcess

__all__ = ["ProcessProxy", "launch_process"]

_STARTUP_TIMEOUT = 5.0  # seconds
_SHUTDOWN_TIMEOUT = 20.0  # seconds, longer than those of the signals of a process together


class ProcessProxy:
    """A process of a test: its state and its output, and methods that wait for them.

    Args:
        process_action: The action of the process.
        proc_info: The events of the processes.
        proc_output: The output of the processes.
        output_filter: Function that returns the part of the output to examine.
    """

    def __init__(
        self,
        process_action: ExecuteProcess,
        proc_info: Any,
        proc_output: Any,
        *,
        output_filter: Callable[[str], str] | None = None,
    ) -> None:
        self._action = process_action
        self._proc_info = proc_info
        self._proc_output = proc_output
        self._output_filter = output_filter

    def wait_for_shutdown(self, timeout: float | None = None) -> bool:
        """Wait for the end of the process, and return whether it has ended.

        Args:
            timeout: Seconds to wait, or None for no limit.
        """
        try:
            self._proc_info.assertWaitForShutdown(process=self._action, timeout=timeout)
        except AssertionError:
            return False
        return True

    def wait_for_output(self, condition: Any = None, timeout: float | None = None) -> bool:
        """Wait for output of the process, and return whether it has been written.

        Args:
            condition: A text, a regular expression, a list of them, or a function of the whole output; any output by
                default.
            timeout: Seconds to wait, or None for no limit.
        """
        expected = bool if condition is None else condition
        changed = self._proc_output._changed  # noqa: SLF001 - the same package
        with changed:
            return bool(changed.wait_for(lambda: self._matches(expected), timeout))

    def _matches(self, expected: Any) -> bool:
        try:
            processes = resolveProcesses(self._proc_output, process=self._action)
        except NoMatchingProcessException:
            return False
        if callable(expected):
            return bool(expected(self.output))
        return any(
            output_contains(
                self._proc_output,
                processes,
                expected,
                stream,
                output_filter=self._output_filter,
                strip_ansi_escape_sequences=True,
            )
            for stream in ("stdout", "stderr")
        )

    @property
    def running(self) -> bool:
        """Whether the process has started and not ended."""
        return self._event is not None and not self.terminated

    @property
    def terminated(self) -> bool:
        """Whether the process has ended."""
        return hasattr(self._event, "returncode")

    @property
    def exit_code(self) -> int | None:
        """The exit code; None while the process runs."""
        return getattr(self._event, "returncode", None)

    @property
    def stdout(self) -> str:
        """The standard output so far."""
        return self._text(lambda event: event.from_stdout)

    @property
    def stderr(self) -> str:
        """The standard error so far."""
        return self._text(lambda event: event.from_stderr)

    @property
    def output(self) -> str:
        """The standard output and the standard error so far."""
        return self._text(lambda _: True)

    @property
    def _event(self) -> Any:
        try:
            return self._proc_info[self._action]
        except KeyError:
            return None

    def _text(self, selects: Callable[[Any], bool]) -> str:
        parts = [event.text for event in self._proc_output[self._action] if selects(event)]
        text = b"".join(parts).decode(errors="replace").replace("\r\n", "\n")
        return text if self._output_filter is None else self._output_filter(text)


@contextmanager
def launch_process(
    launch_service: LaunchService,
    process_action: ExecuteProcess,
    proc_info: Any,
    proc_output: Any,
    *,
    output_filter: Callable[[str], str] | None = None,
) -> Iterator[ProcessProxy]:
    """Start a process, yield its proxy, and end the process afterwards.

    Args:
        launch_service: The service that runs.
        process_action: The process to start.
        proc_info: The events of the processes.
        proc_output: The output of the processes.
        output_filter: Function that returns the part of the output to examine.

    Raises:
        AssertionError: The process does not start or end in time.
    """
    launch_service.include_launch_description(LaunchDescription([process_action]))
    proc_info.assertWaitForStartup(process=process_action, timeout=_STARTUP_TIMEOUT)
    proxy = ProcessProxy(process_action, proc_info, proc_output, output_filter=output_filter)
    try:
        yield proxy
    finally:
        if not proxy.terminated:
            launch_service.emit_event(ShutdownProcess(process_matcher=matches_action(process_action)))
            proc_info.assertWaitForShutdown(process=process_action, timeout=_SHUTDOWN_TIMEOUT)
