# SPDX-License-Identifier: Apache-2.0
"""Executors, which wait until timers, subscriptions and other waitables are ready and run their callbacks."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import inspect
import os
import threading
import time
import weakref
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any, Final, Protocol

from rclpy import _absent
from rclpy._numbers import require_number
from rclpy.constants import S_TO_NS
from rclpy.exceptions import NotInitializedException, RCLError, ROSInterruptException
from rclpy.task import Future, Task
from rclpy.utilities import get_default_context
from rclpy.waitable import NumberOfEntities, Waitable  # noqa: F401 - programs import them from here

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine, Iterable, Iterator
    from types import TracebackType

    from typing_extensions import Self

    from rclpy.callback_groups import CallbackGroup
    from rclpy.context import Context
    from rclpy.node import Node

# Errors that a callback may raise when the context is shut down while it runs.
_SHUTDOWN_ERRORS: Final = (NotInitializedException, RCLError, ROSInterruptException)


_THREAD_NAME: Final = "rclpy"


class TimeoutException(Exception):
    """No callback became ready in time."""


class ShutdownException(Exception):
    """The executor was shut down."""


class ExternalShutdownException(Exception):
    """The context was shut down by a signal or by `rclpy.shutdown()`."""

    def __init__(self, *args: object) -> None:
        super().__init__("Execution has been interrupted by shutdown" if not args else args[0], *args[1:])


class ConditionReachedException(Exception):
    """The condition that ends a wait is met."""


class ExecutorEntity(Protocol):
    """Interface of the entities that an executor waits for: timers, subscriptions, guard conditions, ..."""

    callback_group: CallbackGroup

    def _Coframe__remaining_ns(self) -> int | None:
        """Return the nanoseconds until the entity is ready, 0 or less if it is ready now.

        None means that it is not ready before the context's wakeup is set.
        """

    def _Coframe__take(self) -> Callable[[], Any] | None:
        """Take one ready item and return the call to make, or None if another thread took it first."""


class PolledSubscription(Protocol):
    """Interface of subscriptions without Python callbacks, such as those that write transforms into a native buffer.

    `spin()` ignores them. `spin_once()` returns once for each message, as for a subscription with a callback, because
    programs call it in a loop and look up transforms in between.
    """

    def arm(self) -> None:
        """Let the next message set the context's wakeup. Without this, messages wake no executor."""

    def take_one(self) -> bool:
        """Return whether a message arrived that no `spin_once` has returned for yet, and count it as handled."""


Work = tuple["Task[Any]", "ExecutorEntity | None", "Node | None"]


class Executor:
    """Base class of the executors. Subclasses define in which threads callbacks run.

    Args:
        context: Context whose shutdown ends the spinning. None: the default context.
    """

    def __init__(self, *, context: Context | None = None) -> None:
        self._context = context or get_default_context()
        self._nodes: list[Node] = []
        self.__lock = threading.RLock()
        self.__tasks: deque[Task[Any]] = deque()
        self.__ready: deque[tuple[Task[Any] | ExecutorEntity, Node | None]] = deque()
        self.__run_order: weakref.WeakKeyDictionary[ExecutorEntity, int] = weakref.WeakKeyDictionary()
        self.__run_count = 0
        self.__is_shutdown = False
        self.__is_spinning = False
        self.__running_in: list[int] = []
        self.__is_idle = threading.Condition()

    @property
    def context(self) -> Context:
        """The context whose shutdown ends the spinning."""
        return self._context

    def create_task(
        self,
        callback: Callable[..., Any] | Coroutine[Any, Any, Any],
        *args: Any,
        **kwargs: Any,
    ) -> Task[Any]:
        """Schedule a function or coroutine in this executor.

        Args:
            callback: Function, coroutine function or coroutine to run.
            *args: Positional arguments of the function.
            **kwargs: Keyword arguments of the function.

        Returns:
            The task, which is the future of the result.
        """
        task: Task[Any] = Task(callback, args, kwargs, executor=self)
        self._Coframe__schedule(task)
        return task

    def create_future(self) -> Future[Any]:
        """Return a future whose done callbacks run in this executor."""
        return Future(executor=self)

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Stop spinning and wait for the running callbacks.

        Args:
            timeout_sec: Maximum time to wait in seconds. None: no limit.

        Returns:
            Whether all callbacks finished in time.
        """
        self.__is_shutdown = True
        self.wake()
        me = threading.get_ident()
        with self.__is_idle:
            has_ended = self.__is_idle.wait_for(lambda: set(self.__running_in) <= {me}, timeout_sec)
        for node in self.get_nodes():
            self.remove_node(node)
        return has_ended

    def add_node(self, node: Node) -> bool:
        """Add a node, whose callbacks run while this executor spins.

        Returns:
            Whether the node was added, False if it was added before.

        Raises:
            RuntimeError: The node belongs to another context.
        """
        if node.context is not self._context:
            reason = (
                "and the executor belong to different contexts. Create both with the same context."
                if node.context.ok()
                else "belongs to a context that was shut down. Create a new node after rclpy.init()."
            )
            raise RuntimeError(f"Node '{node._Coframe__names.node_name}' {reason}")
        with self.__lock:
            if node in self._nodes:
                return False
            self._nodes.append(node)
        node.executor = self
        self.wake()
        return True

    def remove_node(self, node: Node) -> None:
        """Remove a node. A node that was not added is ignored."""
        with self.__lock:
            if node not in self._nodes:
                return
            self._nodes.remove(node)
        if node.executor is self:
            node.executor = None
        self.wake()

    def get_nodes(self) -> list[Node]:
        """Return the nodes of this executor."""
        with self.__lock:
            return list(self._nodes)

    def wake(self) -> None:
        """Wake the executor to check again for work and its condition."""
        self._context._Coframe__wakeup.set()

    def spin(self) -> None:
        """Run callbacks until the context or the executor is shut down."""
        self.__is_spinning = True
        try:
            while self._context.ok() and not self.__is_shutdown:
                self.spin_once()
        except ExternalShutdownException:
            pass
        finally:
            self.__is_spinning = False

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait for one callback and run it.

        Args:
            timeout_sec: Maximum time to wait in seconds. None or negative: no limit.

        Raises:
            ExternalShutdownException: The context was shut down.
        """
        self._Coframe__spin_once_unless(lambda: False, timeout_sec, polls_subscriptions=not self.__is_spinning)

    def spin_until_future_complete(self, future: Future[Any], timeout_sec: float | None = None) -> None:
        """Run callbacks until the future is complete.

        Args:
            future: Future to wait for.
            timeout_sec: Maximum time to wait in seconds. None or negative: no limit.

        Raises:
            ExternalShutdownException: The context was shut down.
        """
        deadline = _deadline(timeout_sec)
        while not future._Coframe__is_complete() and not self.__is_shutdown:
            remaining = None if deadline is None else (deadline - time.monotonic_ns()) / S_TO_NS
            if remaining is not None and remaining < 0:
                return
            self.spin_once_until_future_complete(future, remaining)

    def spin_once_until_future_complete(self, future: Future[Any], timeout_sec: float | None = None) -> None:
        """Wait for one callback or for the future; otherwise like `spin_once`."""
        future._Coframe__add_waiter(self.wake)
        self._Coframe__spin_once_unless(future._Coframe__is_complete, timeout_sec)

    def can_execute(self, entity: ExecutorEntity) -> bool:
        """Return whether the callback group of an entity allows its callback to run now."""
        return entity.callback_group.can_execute(entity)

    def wait_for_ready_callbacks(
        self,
        timeout_sec: float | None = None,
        nodes: Iterable[Node] | None = None,
        condition: Callable[[], bool] = lambda: False,
    ) -> Work:
        """Wait for the next ready callback without running it.

        Args:
            timeout_sec: Maximum time to wait in seconds. None or negative: no limit.
            nodes: Nodes to consider. None for all added nodes.
            condition: Function that ends the wait when it returns True.

        Returns:
            The task to call, and its waitable and node, which are None for tasks of `create_task`.

        Raises:
            ExternalShutdownException: The context was shut down.
            ShutdownException: The executor was shut down.
            TimeoutException: No callback was ready in time.
            ConditionReachedException: The condition is met.
        """
        return self._Coframe__wait_for_work(timeout_sec, nodes, condition, polls_subscriptions=False)

    def _wait_for_ready_callbacks(
        self,
        timeout_sec: float | None = None,
        nodes: Iterable[Node] | None = None,
        condition: Callable[[], bool] = lambda: False,
    ) -> Iterator[Work]:
        """Yield the next ready callback, and those that are ready at the same time. See `wait_for_ready_callbacks`."""
        yield self.wait_for_ready_callbacks(timeout_sec, nodes, condition)
        with suppress(TimeoutException):
            while True:
                yield self.wait_for_ready_callbacks(0, nodes, condition)

    def _Coframe__wait_for_work(
        self,
        timeout_sec: float | None,
        nodes: Iterable[Node] | None,
        condition: Callable[[], bool],
        *,
        polls_subscriptions: bool,
    ) -> Work:
        deadline = _deadline(timeout_sec)
        wakeup = self._context._Coframe__wakeup
        while True:
            if not self._context.ok():
                raise ExternalShutdownException
            if self.__is_shutdown:
                raise ShutdownException
            if condition():
                raise ConditionReachedException
            seen = wakeup.count
            work, next_ns = self.__next_work(nodes)
            if work is not None:
                return work
            if polls_subscriptions and self.__take_polled():
                raise ConditionReachedException
            if deadline is not None:
                remaining = deadline - time.monotonic_ns()
                if remaining <= 0:
                    raise TimeoutException
                next_ns = remaining if next_ns is None else min(next_ns, remaining)
            wakeup.wait(seen, next_ns)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.shutdown()

    def _Coframe__run(self, task: Task[Any]) -> None:
        """Run a ready task and raise the exceptions of callbacks."""
        raise NotImplementedError(f"{type(self).__name__} does not implement spin_once()")

    def _Coframe__has_capacity(self) -> bool:
        """Return whether another callback can run now."""
        return True

    def _Coframe__schedule(self, task: Task[Any]) -> None:
        self.__tasks.append(task)
        self.wake()

    def __take_polled(self) -> bool:
        """Return whether a polled subscription has received a message, otherwise let the next one set the wakeup."""
        polled = [subscription for node in self.get_nodes() for subscription in node._Coframe__polled_subscriptions]
        for subscription in polled:
            subscription.arm()
        return any(subscription.take_one() for subscription in polled)

    def _Coframe__spin_once_unless(
        self, condition: Callable[[], bool], timeout_sec: float | None, *, polls_subscriptions: bool = False
    ) -> None:
        try:
            task, _, _ = self._Coframe__wait_for_work(
                timeout_sec, None, condition, polls_subscriptions=polls_subscriptions
            )
        except (ShutdownException, TimeoutException, ConditionReachedException):
            return
        self._Coframe__run(task)

    def _Coframe__call(self, task: Task[Any]) -> None:
        """Run a task in this thread, and register it so that `shutdown` waits for it."""
        me = threading.get_ident()
        self.__running_in.append(me)
        try:
            task()
        finally:
            with self.__is_idle:
                self.__running_in.remove(me)
                self.__is_idle.notify_all()

    def _Coframe__raise_error_of(self, task: Task[Any]) -> None:
        error = task.exception()
        is_shutdown = isinstance(error, _SHUTDOWN_ERRORS) and not self._context.ok()
        if error is not None and not is_shutdown:
            raise error

    def __next_work(self, nodes: Iterable[Node] | None) -> tuple[Work | None, int | None]:
        """Return the next ready work, or None and the nanoseconds until the next timer."""
        if not self._Coframe__has_capacity():
            return None, None
        with self.__lock:
            allowed = self._nodes if nodes is None else [node for node in nodes if node in self._nodes]
            while True:
                # All entities that were ready run once before any of them runs again.
                while self.__ready:
                    ready, node = self.__ready.popleft()
                    if (work := self.__begin(ready, node, allowed)) is not None:
                        return work, None
                next_ns = self.__collect_ready(allowed)
                if not self.__ready:
                    return None, next_ns

    def __collect_ready(self, nodes: Iterable[Node]) -> int | None:
        while self.__tasks:
            self.__ready.append((self.__tasks.popleft(), None))
        next_ns: int | None = None
        ready: list[tuple[ExecutorEntity, Node]] = []
        for node in nodes:
            for entity in node._Coframe__entities.waitables:
                remaining = entity._Coframe__remaining_ns()
                if remaining is None:
                    continue
                if remaining > 0:
                    next_ns = remaining if next_ns is None else min(next_ns, remaining)
                elif self.can_execute(entity):
                    ready.append((entity, node))
        if len(ready) > 1:
            # An entity that is always ready must not starve the others of its callback group.
            ready.sort(key=lambda work: self.__run_order.get(work[0], 0))
        self.__ready.extend(ready)
        return next_ns

    def __begin(self, ready: Task[Any] | ExecutorEntity, node: Node | None, allowed: list[Node]) -> Work | None:
        if isinstance(ready, Task):
            return ready, None, None
        if node not in allowed or not ready.callback_group.beginning_execution(ready):
            return None
        self.__run_count += 1
        self.__run_order[ready] = self.__run_count
        call = None
        try:
            call = ready._Coframe__take()
        finally:
            if call is None:
                ready.callback_group.ending_execution(ready)
        return None if call is None else (Task(self.__execute, (ready, call), executor=self), ready, node)

    async def __execute(self, entity: ExecutorEntity, call: Callable[[], Any]) -> None:
        try:
            result = call()
            if inspect.iscoroutine(result):
                await result
        finally:
            entity.callback_group.ending_execution(entity)
            self.wake()


class SingleThreadedExecutor(Executor):
    """Executor that runs callbacks in the spinning thread."""

    def _Coframe__run(self, task: Task[Any]) -> None:
        self._Coframe__call(task)
        self._Coframe__raise_error_of(task)


class MultiThreadedExecutor(Executor):
    """Executor that runs callbacks in a thread pool. Callback groups define which may run in parallel.

    Args:
        num_threads: Size of the pool. None: the number of processors, at least 2.
        context: Context whose shutdown ends the spinning. None: the default context.

    Raises:
        ValueError: The size is not positive.
    """

    def __init__(self, num_threads: int | None = None, *, context: Context | None = None) -> None:
        super().__init__(context=context)
        if num_threads is not None and num_threads <= 0:
            raise ValueError("max_workers must be greater than 0")
        self.__num_threads = max(os.cpu_count() or 4, 2) if num_threads is None else num_threads
        self.__pool = self.__new_pool()
        self.__free = self.__num_threads
        self.__free_lock = threading.Lock()
        self.__failed: deque[Task[Any]] = deque()

    def shutdown(self, timeout_sec: float | None = None, *, wait_for_threads: bool = True) -> bool:
        """Stop spinning and wait for the running callbacks. See `Executor.shutdown`.

        Args:
            timeout_sec: Maximum time to wait for the callbacks in seconds. None: no limit.
            wait_for_threads: Whether to wait until the threads have ended as well, if all callbacks ended in time.
        """
        has_ended = super().shutdown(timeout_sec)
        is_in_pool = threading.current_thread().name.startswith(_THREAD_NAME)
        self.__pool.shutdown(wait=wait_for_threads and has_ended and not is_in_pool)
        return has_ended

    def _Coframe__wait_for_work(
        self,
        timeout_sec: float | None,
        nodes: Iterable[Node] | None,
        condition: Callable[[], bool],
        *,
        polls_subscriptions: bool,
    ) -> Work:
        """Wait for work, or for the failure of a callback in the pool."""

        def failed_or_condition() -> bool:
            return bool(self.__failed) or condition()

        return super()._Coframe__wait_for_work(
            timeout_sec, nodes, failed_or_condition, polls_subscriptions=polls_subscriptions
        )

    def _Coframe__spin_once_unless(
        self, condition: Callable[[], bool], timeout_sec: float | None, *, polls_subscriptions: bool = False
    ) -> None:
        super()._Coframe__spin_once_unless(condition, timeout_sec, polls_subscriptions=polls_subscriptions)
        if self.__failed:
            self._Coframe__raise_error_of(self.__failed.popleft())

    def _Coframe__has_capacity(self) -> bool:
        # Taking more messages than there are threads would move them from bounded queues to an unbounded one.
        return self.__free > 0

    def _Coframe__run(self, task: Task[Any]) -> None:
        with self.__free_lock:
            self.__free -= 1
        try:
            self.__pool.submit(self.__run_in_pool, task)
        except RuntimeError as error:  # The interpreter is shutting down.
            task.cancel()
            raise ExternalShutdownException from error
        except BaseException:
            # Ctrl-C may have interrupted the start of a thread. The pool does not know this thread, so that nothing
            # would end it when the program exits, except the end of the pool.
            self.__pool.shutdown(wait=False)
            self.__pool = self.__new_pool()
            raise

    def __new_pool(self) -> ThreadPoolExecutor:
        return ThreadPoolExecutor(self.__num_threads, thread_name_prefix=_THREAD_NAME)

    def __run_in_pool(self, task: Task[Any]) -> None:
        try:
            self._Coframe__call(task)
        except BaseException as error:  # noqa: BLE001 - the spinning thread raises it
            task.set_exception(error)
        finally:
            if task.done() and task.exception() is not None:
                self.__failed.append(task)
            with self.__free_lock:
                self.__free += 1
            self.wake()


def _deadline(timeout_sec: float | None) -> int | None:
    if timeout_sec is None or timeout_sec < 0:
        return None
    return time.monotonic_ns() + int(require_number(timeout_sec) * S_TO_NS)


async def await_or_execute(callback: Callable[..., Any], *args: Any) -> Any:
    """Call a function, or await a coroutine function, and return the result."""
    result = callback(*args)
    return await result if inspect.isawaitable(result) else result


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
