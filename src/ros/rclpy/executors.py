"""Executors: they wait until timers, messages, ... are due and run their callbacks."""

# The modules of rclpy share what its users do not see.
# ruff: noqa: SLF001

from __future__ import annotations

import inspect
import os
import threading
import time
import weakref
from abc import ABC, abstractmethod
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, Final, Protocol

from rclpy.constants import S_TO_NS
from rclpy.exceptions import NotInitializedException, RCLError, ROSInterruptException
from rclpy.task import Future, Task
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine, Iterable
    from types import TracebackType

    from typing_extensions import Self

    from rclpy.callback_groups import CallbackGroup
    from rclpy.context import Context
    from rclpy.node import Node

# How often `spin_once` looks for what comes in silently: nothing wakes it for that.
_SILENT_INPUT_PERIOD_NS: Final = 5_000_000
# What a callback meets when the context is shut down under it.
_ERRORS_OF_THE_END: Final = (NotInitializedException, RCLError, ROSInterruptException)


class TimeoutException(Exception):
    """Nothing became ready in time."""


class ShutdownException(Exception):
    """The executor was shut down."""


class ExternalShutdownException(Exception):
    """The context was shut down, by a signal or by `rclpy.shutdown()` elsewhere."""

    def __init__(self, *args: object) -> None:
        super().__init__("Execution has been interrupted by shutdown" if not args else args[0], *args[1:])


class ConditionReachedException(Exception):
    """What a spin was waiting for has happened."""


class Executable(Protocol):
    """A timer, subscription, ... as an executor sees it."""

    callback_group: CallbackGroup

    def _remaining_ns(self) -> int | None:
        """Nanoseconds until it is due, 0 or less when it is; None: not before the context's wakeup is set."""

    def _take(self) -> Callable[[], Any] | None:
        """Takes what is due away and returns the call to make; None if another thread was faster."""


class SilentInput(Protocol):
    """What comes in without a callback, such as transforms, which go into a buffer natively.

    `spin()` lets it. `spin_once()` returns for each message, as it would for one with a callback: programs loop over
    it and look at their buffer in between.
    """

    def _take_one(self) -> bool:
        """Whether a message has come in that no `spin_once` has returned for; the next call tells of the next one."""


Work = tuple["Task[Any]", "Executable | None", "Node | None"]


class Executor(ABC):
    """Waits for the nodes added to it; its children say in which thread callbacks run.

    Args:
        context: Ends the spinning at its shutdown; None: the default context.
    """

    def __init__(self, *, context: Context | None = None) -> None:
        self._context = context or get_default_context()
        self._nodes: list[Node] = []
        self._lock = threading.RLock()
        self._tasks: deque[Task[Any]] = deque()
        self._due: deque[tuple[Task[Any] | Executable, Node | None]] = deque()
        self._turns: weakref.WeakKeyDictionary[Executable, int] = weakref.WeakKeyDictionary()
        self._turn = 0
        self._is_shutdown = False
        self._is_spinning = False
        self._running_in: list[int] = []
        self._is_idle = threading.Condition()

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
        """Runs a function or coroutine in this executor.

        Args:
            callback: The function, coroutine function or coroutine.
            *args: Its positional arguments.
            **kwargs: Its keyword arguments.

        Returns:
            The future of its result.
        """
        task: Task[Any] = Task(callback, args, kwargs, executor=self)
        self._schedule(task)
        return task

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Stops spinning and waits for callbacks that are running.

        Args:
            timeout_sec: Longest wait in seconds; None: as long as it takes.

        Returns:
            Whether all callbacks ended in time.
        """
        self._is_shutdown = True
        self.wake()
        me = threading.get_ident()
        with self._is_idle:
            has_ended = self._is_idle.wait_for(lambda: set(self._running_in) <= {me}, timeout_sec)
        for node in self.get_nodes():
            self.remove_node(node)
        return has_ended

    def add_node(self, node: Node) -> bool:
        """Adds a node; its callbacks run while this executor spins.

        Returns:
            Whether it was not there before.

        Raises:
            RuntimeError: The node belongs to another context.
        """
        if node.context is not self._context:
            reason = (
                "and the executor are of different contexts: make both with the same context="
                if node.context.ok()
                else "has ended with rclpy.shutdown(): make a new one after rclpy.init()"
            )
            raise RuntimeError(f"node '{node.get_name()}' {reason}")
        with self._lock:
            if node in self._nodes:
                return False
            self._nodes.append(node)
        node.executor = self
        self.wake()
        return True

    def remove_node(self, node: Node) -> None:
        """Removes a node; one that is not there is no error."""
        with self._lock:
            if node not in self._nodes:
                return
            self._nodes.remove(node)
        if node.executor is self:
            node.executor = None
        self.wake()

    def get_nodes(self) -> list[Node]:
        """Returns the nodes added to it."""
        with self._lock:
            return list(self._nodes)

    def wake(self) -> None:
        """Makes it look for work, or at its condition, again."""
        self._context._wakeup.set()

    def spin(self) -> None:
        """Runs callbacks until the context or the executor is shut down."""
        self._is_spinning = True
        try:
            while self._context.ok() and not self._is_shutdown:
                self.spin_once()
        except ExternalShutdownException:
            pass
        finally:
            self._is_spinning = False

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Waits for one callback and runs it.

        Args:
            timeout_sec: Longest wait in seconds; None or negative: as long as it takes.

        Raises:
            ExternalShutdownException: The context was shut down.
        """
        self._spin_once_unless(lambda: False, timeout_sec, heeds_silence=not self._is_spinning)

    def spin_until_future_complete(self, future: Future[Any], timeout_sec: float | None = None) -> None:
        """Runs callbacks until the future is over.

        Args:
            future: What to wait for.
            timeout_sec: Longest wait in seconds; None or negative: as long as it takes.

        Raises:
            ExternalShutdownException: The context was shut down.
        """
        future._add_waiter(self.wake)
        deadline = _deadline(timeout_sec)
        while not future._is_over() and not self._is_shutdown:
            remaining = None if deadline is None else (deadline - time.monotonic_ns()) / S_TO_NS
            if remaining is not None and remaining < 0:
                return
            self._spin_once_unless(future._is_over, remaining)

    def spin_once_until_future_complete(self, future: Future[Any], timeout_sec: float | None = None) -> None:
        """Waits for one callback or the future's end, and runs the callback; otherwise as `spin_once`."""
        future._add_waiter(self.wake)
        self._spin_once_unless(future._is_over, timeout_sec)

    def can_execute(self, entity: Executable) -> bool:
        """Whether the callback group of a timer, subscription, ... lets its callback run now."""
        return entity.callback_group.can_execute(entity)

    def wait_for_ready_callbacks(
        self,
        timeout_sec: float | None = None,
        nodes: Iterable[Node] | None = None,
        condition: Callable[[], bool] = lambda: False,
    ) -> Work:
        """Waits for the next callback that is due, without running it.

        Args:
            timeout_sec: Longest wait in seconds; None or negative: as long as it takes.
            nodes: Look at these nodes only; None: at all that were added.
            condition: Ends the wait when it holds.

        Returns:
            The task to call; its timer, subscription, ... and node, None for tasks of `create_task`.

        Raises:
            ExternalShutdownException: The context was shut down.
            ShutdownException: The executor was.
            TimeoutException: Nothing was due in time.
            ConditionReachedException: The condition holds.
        """
        return self._wait_for_work(timeout_sec, nodes, condition, heeds_silence=False)

    def _wait_for_work(
        self,
        timeout_sec: float | None,
        nodes: Iterable[Node] | None,
        condition: Callable[[], bool],
        *,
        heeds_silence: bool,
    ) -> Work:
        deadline = _deadline(timeout_sec)
        wakeup = self._context._wakeup
        while True:
            if not self._context.ok():
                raise ExternalShutdownException
            if self._is_shutdown:
                raise ShutdownException
            if condition():
                raise ConditionReachedException
            seen = wakeup.count
            work, next_ns = self._next_work(nodes)
            if work is not None:
                return work
            silent_inputs = self._silent_inputs() if heeds_silence else []
            if any(entrance._take_one() for entrance in silent_inputs):
                raise ConditionReachedException
            if silent_inputs:
                next_ns = _SILENT_INPUT_PERIOD_NS if next_ns is None else min(next_ns, _SILENT_INPUT_PERIOD_NS)
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

    @abstractmethod
    def _run(self, task: Task[Any]) -> None:
        """Runs a task that is due and raises what callbacks raised."""

    def _has_room(self) -> bool:
        """Whether one more callback can be run now."""
        return True

    def _schedule(self, task: Task[Any]) -> None:
        self._tasks.append(task)
        self.wake()

    def _silent_inputs(self) -> list[SilentInput]:
        return [entrance for node in self.get_nodes() for entrance in node._silent_inputs]

    def _spin_once_unless(
        self, condition: Callable[[], bool], timeout_sec: float | None, *, heeds_silence: bool = False
    ) -> None:
        try:
            task, _, _ = self._wait_for_work(timeout_sec, None, condition, heeds_silence=heeds_silence)
        except (ShutdownException, TimeoutException, ConditionReachedException):
            return
        self._run(task)

    def _call(self, task: Task[Any]) -> None:
        """Runs a task in this thread, counted for `shutdown`."""
        me = threading.get_ident()
        self._running_in.append(me)
        try:
            task()
        finally:
            with self._is_idle:
                self._running_in.remove(me)
                self._is_idle.notify_all()

    def _raise_error_of(self, task: Task[Any]) -> None:
        error = task.exception()
        is_end = isinstance(error, _ERRORS_OF_THE_END) and not self._context.ok()
        if error is not None and not is_end:
            raise error

    def _next_work(self, nodes: Iterable[Node] | None) -> tuple[Work | None, int | None]:
        """What is due, if anything, else nanoseconds until the next timer is."""
        if not self._has_room():
            return None, None
        with self._lock:
            allowed = self._nodes if nodes is None else [node for node in nodes if node in self._nodes]
            while True:
                # Everything that was due gets its turn before anything does again.
                while self._due:
                    due, node = self._due.popleft()
                    if (work := self._begin(due, node, allowed)) is not None:
                        return work, None
                next_ns = self._look_for_due(allowed)
                if not self._due:
                    return None, next_ns

    def _look_for_due(self, nodes: Iterable[Node]) -> int | None:
        while self._tasks:
            self._due.append((self._tasks.popleft(), None))
        next_ns: int | None = None
        due: list[tuple[Executable, Node]] = []
        for node in nodes:
            for entity in node._executables():
                remaining = entity._remaining_ns()
                if remaining is None:
                    continue
                if remaining > 0:
                    next_ns = remaining if next_ns is None else min(next_ns, remaining)
                elif self.can_execute(entity):
                    due.append((entity, node))
        if len(due) > 1:
            # Who is always due must not keep the others of its callback group from ever running.
            due.sort(key=lambda work: self._turns.get(work[0], 0))
        self._due.extend(due)
        return next_ns

    def _begin(self, due: Task[Any] | Executable, node: Node | None, allowed: list[Node]) -> Work | None:
        if isinstance(due, Task):
            return due, None, None
        if node not in allowed or not due.callback_group.beginning_execution(due):
            return None
        self._turn += 1
        self._turns[due] = self._turn
        call = None
        try:
            call = due._take()
        finally:
            if call is None:
                due.callback_group.ending_execution(due)
        return None if call is None else (Task(self._execute, (due, call), executor=self), due, node)

    async def _execute(self, entity: Executable, call: Callable[[], Any]) -> None:
        try:
            result = call()
            if inspect.iscoroutine(result):
                await result
        finally:
            entity.callback_group.ending_execution(entity)
            self.wake()


class SingleThreadedExecutor(Executor):
    """Runs callbacks in the thread that spins."""

    def _run(self, task: Task[Any]) -> None:
        self._call(task)
        self._raise_error_of(task)


class MultiThreadedExecutor(Executor):
    """Runs callbacks in a pool of threads; callback groups say which may run at the same time.

    Args:
        num_threads: Size of the pool; None: the number of processors, at least 2.
        context: Ends the spinning at its shutdown; None: the default context.
    """

    def __init__(self, num_threads: int | None = None, *, context: Context | None = None) -> None:
        super().__init__(context=context)
        self._num_threads = num_threads or max(os.cpu_count() or 4, 2)
        self._pool = ThreadPoolExecutor(self._num_threads, thread_name_prefix="rclpy")
        self._free = self._num_threads
        self._failed: deque[Task[Any]] = deque()

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Stops spinning and waits for callbacks that are running; see `Executor.shutdown`."""
        has_ended = super().shutdown(timeout_sec)
        self._pool.shutdown(wait=False)
        return has_ended

    def _wait_for_work(
        self,
        timeout_sec: float | None,
        nodes: Iterable[Node] | None,
        condition: Callable[[], bool],
        *,
        heeds_silence: bool,
    ) -> Work:
        """Also ends when a callback that ran in the pool has failed."""
        ends = lambda: bool(self._failed) or condition()  # noqa: E731 - too short for a name of its own
        return super()._wait_for_work(timeout_sec, nodes, ends, heeds_silence=heeds_silence)

    def _spin_once_unless(
        self, condition: Callable[[], bool], timeout_sec: float | None, *, heeds_silence: bool = False
    ) -> None:
        super()._spin_once_unless(condition, timeout_sec, heeds_silence=heeds_silence)
        if self._failed:
            self._raise_error_of(self._failed.popleft())

    def _has_room(self) -> bool:
        # Taking more than there are threads for would empty the queues of DDS into one without bounds here.
        return self._free > 0

    def _run(self, task: Task[Any]) -> None:
        with self._lock:
            self._free -= 1
        try:
            self._pool.submit(self._run_in_pool, task)
        except RuntimeError as error:  # the interpreter is about to end
            task.cancel()
            raise ExternalShutdownException from error

    def _run_in_pool(self, task: Task[Any]) -> None:
        try:
            self._call(task)
        finally:
            if task.done() and task.exception() is not None:
                self._failed.append(task)
            with self._lock:
                self._free += 1
            self.wake()


def _deadline(timeout_sec: float | None) -> int | None:
    if timeout_sec is None or timeout_sec < 0:
        return None
    return time.monotonic_ns() + int(timeout_sec * S_TO_NS)
