# SPDX-License-Identifier: Apache-2.0
"""Support for awaiting rclpy's futures in asyncio tasks."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import sys
import threading
from contextlib import suppress
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Coroutine, Generator

    from rclpy.task import Future


class _Thread(threading.local):
    """Per-thread state."""

    # The asyncio task that is blocked while rclpy runs a coroutine inside it, for example in `executor.spin_once()`.
    suspended: asyncio.Task[Any] | None = None


_thread = _Thread()


def step(coroutine: Coroutine[Any, Any, Any]) -> Any:
    """Run a coroutine of an rclpy task to its next await, which rclpy handles, not asyncio."""
    outer, _thread.suspended = _thread.suspended, _current_task()
    try:
        return coroutine.send(None)
    finally:
        _thread.suspended = outer


def awaiting_loop() -> asyncio.AbstractEventLoop | None:
    """Return the loop of the asyncio task that awaits in this thread.

    Return None if rclpy, or the program itself by `send()`, runs the coroutine.
    """
    task = _current_task()
    return None if task is None or task is _thread.suspended else task.get_loop()


def wait_until_complete(future: Future[Any], loop: asyncio.AbstractEventLoop) -> Generator[Any, None, None]:
    """Suspend the awaiting task until the future is complete. Cancelling the task cancels the future."""
    waiter = loop.create_future()

    def wake() -> None:
        with suppress(RuntimeError):  # The loop is closed, so no task waits in it.
            loop.call_soon_threadsafe(_complete, waiter)

    future._Coframe__add_waiter(wake)
    try:
        # asyncio requires that futures are awaited through their own `__await__`.
        yield next(waiter.__await__())
    except cancelled_error():
        future.cancel()
        raise
    finally:
        future._Coframe__remove_waiter(wake)


def cancelled_error() -> type[BaseException]:
    """Return asyncio's exception for cancelled tasks, importing asyncio only if needed."""
    import asyncio  # noqa: PLC0415

    return asyncio.CancelledError


def _current_task() -> asyncio.Task[Any] | None:
    # While another thread imports asyncio, the module is there without its functions, and this thread runs no loop.
    current_task = getattr(sys.modules.get("asyncio"), "current_task", None)
    if current_task is None:
        return None
    try:
        task: asyncio.Task[Any] | None = current_task()
    except RuntimeError:  # No loop is running in this thread.
        return None
    return task


def _complete(waiter: asyncio.Future[None]) -> None:
    if not waiter.done():
        waiter.set_result(None)
