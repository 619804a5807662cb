"""Awaiting rclpy's futures in asyncio's tasks, which know other futures only."""

# The modules of rclpy share what its users do not see.
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
    """What each thread is in the midst of."""

    # The asyncio task that stands still while rclpy drives a coroutine inside it (`executor.spin_once()`, say).
    suspended: asyncio.Task[Any] | None = None


_thread = _Thread()


def step(coroutine: Coroutine[Any, Any, Any]) -> Any:
    """Runs a coroutine of rclpy's to its next await; what it awaits there is rclpy's matter, not asyncio's."""
    outer, _thread.suspended = _thread.suspended, _current_task()
    try:
        return coroutine.send(None)
    finally:
        _thread.suspended = outer


def awaiting_loop() -> asyncio.AbstractEventLoop | None:
    """The loop whose task awaits in this thread; None where rclpy or a program's own hand drives the coroutine."""
    task = _current_task()
    return None if task is None or task is _thread.suspended else task.get_loop()


def until_over(future: Future[Any], loop: asyncio.AbstractEventLoop) -> Generator[Any, None, None]:
    """Suspends the awaiting task until the future is over; cancelling the task cancels the future."""
    waiter = loop.create_future()

    def wake() -> None:
        with suppress(RuntimeError):  # the loop is closed, so nobody waits there any more
            loop.call_soon_threadsafe(_complete, waiter)

    future._add_waiter(wake)
    try:
        # By its own `__await__` the waiter learns that it is awaited, which asyncio checks.
        yield next(waiter.__await__())
    except cancelled_error():
        future.cancel()
        raise
    finally:
        future._remove_waiter(wake)


def cancelled_error() -> type[BaseException]:
    """What asyncio raises in cancelled tasks; a function, because most programs never import asyncio."""
    import asyncio  # noqa: PLC0415

    return asyncio.CancelledError


def _current_task() -> asyncio.Task[Any] | None:
    module = sys.modules.get("asyncio")
    if module is None:
        return None
    try:
        task: asyncio.Task[Any] | None = module.current_task()
    except RuntimeError:  # no loop runs in this thread
        return None
    return task


def _complete(waiter: asyncio.Future[None]) -> None:
    if not waiter.done():
        waiter.set_result(None)
