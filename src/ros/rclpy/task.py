# SPDX-License-Identifier: Apache-2.0
"""Futures and tasks."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import inspect
import sys
import threading
import traceback
import weakref
from contextlib import suppress
from enum import Enum
from functools import partial
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from rclpy import _absent, _asyncio

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine, Generator

    from rclpy.executors import Executor

T = TypeVar("T")


class FutureState(Enum):
    """The states of a future, for programs that compare them."""

    PENDING = "PENDING"
    CANCELLED = "CANCELLED"
    FINISHED = "FINISHED"


class Future(Generic[T]):
    """A future result, which coroutines of an executor or of asyncio can await.

    An asyncio task that awaits the future is suspended until any thread sets the result. Cancelling the task cancels
    the future. A cancelled future raises `asyncio.CancelledError` in the task, as asyncio's own futures do; in a
    coroutine of an executor it returns None.

    Args:
        executor: Executor that runs the done callbacks. None: they run immediately in the thread that sets the result.
    """

    def __init__(self, *, executor: Executor | None = None) -> None:
        self._lock = threading.Lock()
        self._done = False
        self._cancelled = False
        self._result: T | None = None
        self._exception: BaseException | None = None
        self._exception_fetched = False
        self._callbacks: list[Callable[[Future[T]], object]] = []
        self._Coframe__waiters: list[Callable[[], object]] = []
        self._executor: Callable[[], Executor | None] = _no_executor
        self._set_executor(executor)

    def __del__(self) -> None:
        if self._exception is not None and not self._exception_fetched and sys.stderr is not None:
            sys.stderr.write(f"The following exception was never retrieved: {self._exception}\n")

    def __await__(self) -> Generator[Any, None, T | None]:
        while not self._Coframe__is_complete():
            if (loop := _asyncio.awaiting_loop()) is not None:
                yield from _asyncio.wait_until_complete(self, loop)
            else:
                yield self
        if self._cancelled and _asyncio.awaiting_loop() is not None:
            raise _asyncio.cancelled_error()
        return self.result()

    def cancel(self) -> None:
        """Cancel the future unless it is done."""
        with self._lock:
            if self._done:
                return
            self._cancelled = True
        self.__notify_complete()

    def cancelled(self) -> bool:
        """Return whether the future was cancelled."""
        return self._cancelled

    def done(self) -> bool:
        """Return whether there is a result or an exception."""
        return self._done

    def result(self) -> T | None:
        """Return the result, or None if there is none yet. Raise the exception if one was set."""
        if self._exception is not None:
            self._exception_fetched = True
            raise self._exception
        return self._result

    def exception(self) -> BaseException | None:
        """Return the exception if one was set, otherwise None."""
        self._exception_fetched = True
        return self._exception

    def set_result(self, result: T) -> None:
        """Set the result and complete the future."""
        with self._lock:
            self._result = result
            self._done = True
            self._cancelled = False
        self.__notify_complete()

    def set_exception(self, exception: BaseException) -> None:
        """Set an exception and complete the future."""
        with self._lock:
            self._exception = exception
            self._exception_fetched = False
            self._done = True
            self._cancelled = False
        self.__notify_complete()

    def add_done_callback(self, callback: Callable[[Future[T]], object]) -> None:
        """Call `callback` with this future when it is complete, or immediately if it is complete already."""
        with self._lock:
            if not self._Coframe__is_complete():
                self._callbacks.append(callback)
                return
        executor = self._executor()
        if executor is not None:
            executor.create_task(callback, self)
        else:
            callback(self)

    def remove_done_callback(self, callback: Callable[[Future[T]], object]) -> bool:
        """Remove a callback that `add_done_callback` added.

        Returns:
            Whether it was removed, False if it was not added or the future is complete.
        """
        with self._lock:
            if callback not in self._callbacks:
                return False
            self._callbacks.remove(callback)
            return True

    def _Coframe__is_complete(self) -> bool:
        return self._done or self._cancelled

    def _set_executor(self, executor: Executor | None) -> None:
        self._executor = _no_executor if executor is None else weakref.ref(executor)

    def _Coframe__add_waiter(self, wake: Callable[[], object]) -> None:
        """Call `wake` once when the future is complete, always immediately and in the completing thread."""
        with self._lock:
            if not self._Coframe__is_complete():
                if wake not in self._Coframe__waiters:
                    self._Coframe__waiters.append(wake)
                return
        wake()

    def _Coframe__remove_waiter(self, wake: Callable[[], object]) -> None:
        """Remove a waiter. A waiter that was called already is ignored."""
        with self._lock, suppress(ValueError):
            self._Coframe__waiters.remove(wake)

    def __notify_complete(self) -> None:
        with self._lock:
            callbacks, self._callbacks = self._callbacks, []
            waiters, self._Coframe__waiters = self._Coframe__waiters, []
        executor = self._executor()
        for callback in callbacks:
            if executor is not None:
                executor.create_task(callback, self)
            else:
                _call_safely(callback, self)
        for wake in waiters:
            wake()


class Task(Future[T]):
    """A function or coroutine that an executor runs, and the future of its result.

    Args:
        handler: Function, coroutine function or coroutine to run.
        args: Positional arguments of the function.
        kwargs: Keyword arguments of the function.
        executor: Executor that continues a coroutine when an awaited future is complete.
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
        self.__execution_lock = threading.Lock()
        if inspect.iscoroutinefunction(handler):
            handler = handler(*self._args, **self._kwargs)
        self._handler: Any = handler

    def __call__(self) -> None:
        """Run the task to its end, or to the next future that it must await."""
        if self._Coframe__is_complete() or not self.__execution_lock.acquire(blocking=False):
            return
        self._executing = True
        try:
            awaited = None if self._Coframe__is_complete() else self.__step()
        finally:
            self._executing = False
            self.__execution_lock.release()
        if self._cancelled:
            self.__close()
        if awaited is not None and not self._Coframe__is_complete():
            awaited._Coframe__add_waiter(self.__continue)
        elif not self._Coframe__is_complete():
            self.__continue()

    def executing(self) -> bool:
        """Return whether the task is currently running."""
        return self._executing

    def cancel(self) -> None:
        """Cancel the task. A coroutine is closed."""
        super().cancel()
        if self._cancelled:
            self.__close()

    def __close(self) -> None:
        """Close the coroutine. A running coroutine is closed after its current step by the thread that runs it."""
        if inspect.iscoroutine(self._handler) and self.__execution_lock.acquire(blocking=False):
            try:
                self._handler.close()
            finally:
                self.__execution_lock.release()

    def __step(self) -> Future[Any] | None:
        """Run one step and return the future that a coroutine awaits, if any."""
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
        except Exception as error:  # noqa: BLE001 - The awaiting code receives the exception.
            self.set_exception(error)
        return None

    def __continue(self) -> None:
        executor = self._executor()
        if executor is not None:
            executor._Coframe__schedule(self)


def _no_executor() -> None:
    return None


def _call_safely(callback: Callable[[Future[T]], object], future: Future[T]) -> None:
    """Call a callback and print its exception, so that the remaining callbacks still run."""
    try:
        callback(future)
    except Exception:  # noqa: BLE001
        traceback.print_exc()


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
