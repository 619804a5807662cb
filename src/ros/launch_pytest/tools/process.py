# SPDX-License-Identifier: Apache-2.0
"""Waits for the start, the output and the end of processes.

The functions whose name ends in ``_sync`` are for tests that are functions, the others for coroutines. Output is kept
only by processes with ``cached_output=True``.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from launch.event_handler import BaseEventHandler
from launch.events.process import RunningProcessEvent

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch import Event, LaunchContext
    from launch.actions import ExecuteProcess

__all__ = [
    "assert_output",
    "assert_output_sync",
    "assert_stderr",
    "assert_stderr_sync",
    "wait_for_exit",
    "wait_for_exit_sync",
    "wait_for_output",
    "wait_for_output_sync",
    "wait_for_start",
    "wait_for_start_sync",
    "wait_for_stderr",
    "wait_for_stderr_sync",
]


def wait_for_start_sync(
    launch_context: LaunchContext, execute_process_action: ExecuteProcess, timeout: float | None = None
) -> bool:
    """Wait for the start of a process, and return whether it has started.

    Args:
        launch_context: The context of the launch.
        execute_process_action: The process.
        timeout: Seconds to wait, or None for no limit.
    """
    return _wait_sync(launch_context, execute_process_action, _has_started(execute_process_action), timeout)


async def wait_for_start(
    launch_context: LaunchContext, execute_process_action: ExecuteProcess, timeout: float | None = None
) -> bool:
    """Wait for the start of a process, as `wait_for_start_sync`."""
    return await _wait(launch_context, execute_process_action, _has_started(execute_process_action), timeout)


def wait_for_exit_sync(
    launch_context: LaunchContext, execute_process_action: ExecuteProcess, timeout: float | None = None
) -> bool:
    """Wait for the end of a process, and return whether it has ended.

    Args:
        launch_context: The context of the launch.
        execute_process_action: The process.
        timeout: Seconds to wait, or None for no limit.
    """
    return _wait_sync(launch_context, execute_process_action, _has_ended(execute_process_action), timeout)


async def wait_for_exit(
    launch_context: LaunchContext, execute_process_action: ExecuteProcess, timeout: float | None = None
) -> bool:
    """Wait for the end of a process, as `wait_for_exit_sync`."""
    return await _wait(launch_context, execute_process_action, _has_ended(execute_process_action), timeout)


def wait_for_output_sync(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Callable[[str], Any],
    timeout: float | None = None,
) -> bool:
    """Wait for standard output of a process, and return whether it was valid in time.

    Args:
        launch_context: The context of the launch.
        execute_process_action: The process.
        validate_output: Function of the whole output so far, which returns False or raises AssertionError while it is
            not valid.
        timeout: Seconds to wait, or None for no limit.
    """
    check = _Check(execute_process_action.get_stdout, validate_output)
    return _wait_sync(launch_context, execute_process_action, check.is_valid, timeout)


async def wait_for_output(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Callable[[str], Any],
    timeout: float | None = None,
) -> bool:
    """Wait for standard output of a process, as `wait_for_output_sync`."""
    check = _Check(execute_process_action.get_stdout, validate_output)
    return await _wait(launch_context, execute_process_action, check.is_valid, timeout)


def assert_output_sync(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Callable[[str], Any],
    timeout: float | None = None,
) -> None:
    """Fail if standard output of a process is not valid in time. For the arguments, see `wait_for_output_sync`.

    Raises:
        AssertionError: The error of `validate_output`, or one with the output.
    """
    check = _Check(execute_process_action.get_stdout, validate_output)
    check.assert_valid(_wait_sync(launch_context, execute_process_action, check.is_valid, timeout))


async def assert_output(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Callable[[str], Any],
    timeout: float | None = None,
) -> None:
    """Fail if the standard output of a process is not valid in time, as `assert_output_sync`."""
    check = _Check(execute_process_action.get_stdout, validate_output)
    check.assert_valid(await _wait(launch_context, execute_process_action, check.is_valid, timeout))


def wait_for_stderr_sync(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Callable[[str], Any],
    timeout: float | None = None,
) -> bool:
    """Wait for standard error of a process. For the arguments, see `wait_for_output_sync`."""
    check = _Check(execute_process_action.get_stderr, validate_output)
    return _wait_sync(launch_context, execute_process_action, check.is_valid, timeout)


async def wait_for_stderr(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Callable[[str], Any],
    timeout: float | None = None,
) -> bool:
    """Wait for standard error of a process, as `wait_for_stderr_sync`."""
    check = _Check(execute_process_action.get_stderr, validate_output)
    return await _wait(launch_context, execute_process_action, check.is_valid, timeout)


def assert_stderr_sync(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Callable[[str], Any],
    timeout: float | None = None,
) -> None:
    """Fail if the standard error of a process is not valid in time, as `assert_output_sync`."""
    check = _Check(execute_process_action.get_stderr, validate_output)
    check.assert_valid(_wait_sync(launch_context, execute_process_action, check.is_valid, timeout))


async def assert_stderr(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Callable[[str], Any],
    timeout: float | None = None,
) -> None:
    """Fail if the standard error of a process is not valid in time, as `assert_stderr_sync`."""
    check = _Check(execute_process_action.get_stderr, validate_output)
    check.assert_valid(await _wait(launch_context, execute_process_action, check.is_valid, timeout))


class _Check:
    """The check of an output, and the last assertion that has failed."""

    def __init__(self, read: Callable[[], bytes], validate: Callable[[str], Any]) -> None:
        self._read_output = read
        self._validate = validate
        self._error: AssertionError | None = None

    def is_valid(self) -> bool:
        """Return whether the output so far is valid."""
        try:
            result = self._validate(self._text())
        except AssertionError as error:
            self._error = error
            return False
        self._error = None
        return result is None or bool(result)

    def assert_valid(self, was_valid: bool) -> None:
        """Raise the last error, or one with the output.

        Raises:
            AssertionError: The output was not valid in time.
        """
        if was_valid:
            return
        if self._error is not None:
            raise self._error
        raise AssertionError(f"timed out waiting for the output; it is {self._text()!r}")

    def _text(self) -> str:
        return self._read_output().decode(errors="replace")


def _has_started(action: ExecuteProcess) -> Callable[[], bool]:
    return lambda: action.process_details is not None


def _has_ended(action: ExecuteProcess) -> Callable[[], bool]:
    return lambda: action.return_code is not None


class _ProcessEventHandler(BaseEventHandler):
    """Calls a function at each event of a process."""

    def __init__(self, action: ExecuteProcess, notify: Callable[[], object]) -> None:
        super().__init__(matcher=lambda event: isinstance(event, RunningProcessEvent) and event.action is action)
        self._notify = notify

    def handle(self, event: Event, context: LaunchContext) -> None:
        """Call the function."""
        super().handle(event, context)
        self._notify()


async def _wait(
    context: LaunchContext, action: ExecuteProcess, condition: Callable[[], bool], timeout: float | None
) -> bool:
    """Check a condition at each event of a process until it holds, and return whether it does."""
    changed = asyncio.Event()
    handler = _ProcessEventHandler(action, changed.set)
    context.register_event_handler(handler)
    try:
        await asyncio.wait_for(_wait_until(condition, changed), timeout)
    except asyncio.TimeoutError:
        return condition()
    finally:
        context.unregister_event_handler(handler)
    return True


async def _wait_until(condition: Callable[[], bool], changed: asyncio.Event) -> None:
    while not condition():
        await changed.wait()
        changed.clear()


def _wait_sync(
    context: LaunchContext, action: ExecuteProcess, condition: Callable[[], bool], timeout: float | None
) -> bool:
    """Check a condition like `_wait`, but in a different thread from the launch."""
    loop = context.asyncio_loop
    if loop is None:  # The launch has ended: nothing changes now.
        return condition()
    return asyncio.run_coroutine_threadsafe(_wait(context, action, condition, timeout), loop).result()
