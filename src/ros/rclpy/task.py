"""Results to come, and the work that brings them."""

# The modules of rclpy share what its users do not see.
# ruff: noqa: SLF001

from __future__ import annotations

import inspect
import sys
import threading
import traceback
import weakref
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from rclpy import _asyncio

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine, Generator

    from rclpy.executors import Executor

T = TypeVar("T")


class Future(Generic[T]):
    """A result to come; can be awaited in coroutines that an executor or asyncio runs.

    An asyncio task that awaits it sleeps until the result is there, from whatever thread. Cancelling the task cancels
    the future, and a future that was cancelled raises `asyncio.CancelledError` there, as asyncio's own futures do; an
    executor's coroutine gets None instead.

    Args:
        executor: Runs the done callbacks; None: they run at once, in the thread that sets the result.
    """

    def __init__(self, *, executor: Executor | None = None) -> None:
        self._lock = threading.Lock()
        self._done = False
        self._cancelled = False
        self._result: T | None = None
        self._exception: BaseException | None = None
        self._exception_fetched = False
        self._callbacks: list[Callable[[Future[T]], object]] = []
        self._waiters: list[Callable[[], object]] = []
        self._executor: Callable[[], Executor | None] = _no_executor
        self._set_executor(executor)

    def __del__(self) -> None:
        if self._exception is not None and not self._exception_fetched and sys.stderr is not None:
            sys.stderr.write(f"The following exception was never retrieved: {self._exception}\n")

    def __await__(self) -> Generator[Any, None, T | None]:
        while not self._is_over():
            if (loop := _asyncio.awaiting_loop()) is not None:
                yield from _asyncio.until_over(self, loop)
            else:
                yield self
        if self._cancelled and _asyncio.awaiting_loop() is not None:
            raise _asyncio.cancelled_error()
        return self.result()

    def cancel(self) -> None:
        """Gives up a result that is not there yet."""
        with self._lock:
            if self._done:
                return
            self._cancelled = True
        self._announce()

    def cancelled(self) -> bool:
        """Whether it was given up."""
        return self._cancelled

    def done(self) -> bool:
        """Whether there is a result or an exception."""
        return self._done

    def result(self) -> T | None:
        """Returns the result, None while there is none, or raises the exception that came instead."""
        if self._exception is not None:
            self._exception_fetched = True
            raise self._exception
        return self._result

    def exception(self) -> BaseException | None:
        """Returns the exception that came instead of a result, if one did."""
        self._exception_fetched = True
        return self._exception

    def set_result(self, result: T) -> None:
        """Brings the result."""
        with self._lock:
            self._result = result
            self._done = True
            self._cancelled = False
        self._announce()

    def set_exception(self, exception: BaseException) -> None:
        """Brings an exception instead of a result."""
        with self._lock:
            self._exception = exception
            self._exception_fetched = False
            self._done = True
            self._cancelled = False
        self._announce()

    def add_done_callback(self, callback: Callable[[Future[T]], object]) -> None:
        """Calls `callback` with this future once it is over; at once if it is."""
        with self._lock:
            if not self._is_over():
                self._callbacks.append(callback)
                return
        executor = self._executor()
        if executor is not None:
            executor.create_task(callback, self)
        else:
            callback(self)

    def _is_over(self) -> bool:
        return self._done or self._cancelled

    def _set_executor(self, executor: Executor | None) -> None:
        self._executor = _no_executor if executor is None else weakref.ref(executor)

    def _add_waiter(self, wake: Callable[[], object]) -> None:
        """Calls `wake` once it is over, always at once and in the thread that brings the end."""
        with self._lock:
            if not self._is_over():
                self._waiters.append(wake)
                return
        wake()

    def _remove_waiter(self, wake: Callable[[], object]) -> None:
        """Forgets a waiter; one that has been called is no error."""
        with self._lock, suppress(ValueError):
            self._waiters.remove(wake)

    def _announce(self) -> None:
        with self._lock:
            callbacks, self._callbacks = self._callbacks, []
            waiters, self._waiters = self._waiters, []
        executor = self._executor()
        for callback in callbacks:
            if executor is not None:
                executor.create_task(callback, self)
            else:
                _call_safely(callback, self)
        for wake in waiters:
            wake()


class Task(Future[T]):
    """A function or coroutine that an executor runs; itself the future of its result.

    Args:
        handler: The function, coroutine function or coroutine.
        args: Its positional arguments.
        kwargs: Its keyword arguments.
        executor: Is told when an awaited future lets a coroutine go on.
    """

    def __init__(
        self,
        handler: Callable[..., Any] | Coroutine[Any, Any, Any],
        args: tuple[Any, ...] | None = None,
        kwargs: dict[str, Any] | None = None,
        executor: Executor | None = None,
    ) -> None:
        super().__init__(executor=executor)
        self._args = args or ()
        self._kwargs = kwargs or {}
        self._executing = False
        self._execution_lock = threading.Lock()
        if inspect.iscoroutinefunction(handler):
            handler = handler(*self._args, **self._kwargs)
        self._handler: Any = handler

    def __call__(self) -> None:
        """Runs it to its end, or to the next future it has to await."""
        if self._is_over() or not self._execution_lock.acquire(blocking=False):
            return
        self._executing = True
        try:
            awaited = None if self._is_over() else self._step()
        finally:
            self._executing = False
            self._execution_lock.release()
        if self._cancelled:
            self._close()
        if awaited is not None and not self._is_over():
            awaited._add_waiter(self._continue)
        elif not self._is_over():
            self._continue()

    def executing(self) -> bool:
        """Whether it is running right now."""
        return self._executing

    def cancel(self) -> None:
        """Gives it up; a coroutine is closed."""
        super().cancel()
        if self._cancelled:
            self._close()

    def _close(self) -> None:
        """Closes the coroutine; one that is running is closed after its step, by the thread that runs it."""
        if inspect.iscoroutine(self._handler) and self._execution_lock.acquire(blocking=False):
            try:
                self._handler.close()
            finally:
                self._execution_lock.release()

    def _step(self) -> Future[Any] | None:
        """Runs once; returns the future that a coroutine awaits."""
        try:
            if not inspect.iscoroutine(self._handler):
                result = self._handler(*self._args, **self._kwargs)
                if inspect.iscoroutine(result):
                    self._handler = result
                    return None
                self.set_result(result)
            else:
                awaited = _asyncio.step(self._handler)
                return awaited if isinstance(awaited, Future) else None
        except StopIteration as stop:
            self.set_result(stop.value)
        except Exception as error:  # noqa: BLE001 - whoever awaits the task gets it
            self.set_exception(error)
        return None

    def _continue(self) -> None:
        executor = self._executor()
        if executor is not None:
            executor._schedule(self)


def _no_executor() -> None:
    return None


def _call_safely(callback: Callable[[Future[T]], object], future: Future[T]) -> None:
    """There may be more callbacks: one that fails is reported only."""
    try:
        callback(future)
    except Exception:  # noqa: BLE001
        traceback.print_exc()
