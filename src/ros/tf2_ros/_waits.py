"""Futures that complete when a buffer learns the transform they wait for, whoever tells it."""

import atexit
import threading
import time
import weakref
from collections.abc import Callable
from dataclasses import dataclass

import coframe
from geometry_msgs.msg import TransformStamped
from rclpy.task import Future
from tf2_py import TransformException

Attempt = Callable[[], TransformStamped]

# How long a watcher sleeps at most: the longest a dropped buffer or the interpreter's end has to wait for it.
_PATIENCE = 50_000_000

_watchers: weakref.WeakSet[threading.Thread] = weakref.WeakSet()
_exiting = threading.Event()


@atexit.register
def _end_watchers() -> None:
    """A thread that comes back from native code into a dying interpreter would take the process down."""
    _exiting.set()
    for watcher in list(_watchers):
        watcher.join(timeout=1.0)


@dataclass(eq=False)
class _Wait:
    attempt: Attempt
    future: Future[TransformStamped]
    deadline: int | None


class Waits:
    """The waits of one buffer.

    Transforms that Python inserts are looked at at once, by the inserting thread. Those that arrive straight from the
    wire, and the end of a wait's time, are noticed by a thread that lives while something is waited for. No lock is
    held while futures complete. When two threads notice the same transform, both bring it; the callbacks run once.
    """

    def __init__(self, buffer: coframe.Buffer) -> None:
        self._buffer = buffer
        self._lock = threading.Lock()
        self._pending: list[_Wait] = []
        self._watcher: threading.Thread | None = None
        self._is_fed_natively = False

    def feed_natively(self) -> None:
        """From now on, transforms arrive that no Python thread inserts."""
        with self._lock:
            self._is_fed_natively = True
            self._watch_if_needed()

    def add(self, attempt: Attempt, timeout: int | None = None) -> Future[TransformStamped]:
        """A future of what `attempt` returns once it no longer raises a `TransformException`.

        Args:
            attempt: The look-up.
            timeout: Nanoseconds after which the future raises what the look-up raised; None waits for ever.
        """
        deadline = None if timeout is None else time.monotonic_ns() + timeout
        wait = _Wait(attempt, Future(), deadline)
        with self._lock:
            self._pending.append(wait)
        self._try(wait)
        with self._lock:
            self._watch_if_needed()
        return wait.future

    def settle(self) -> None:
        """Complete the futures whose transform is known by now, or whose time is over."""
        with self._lock:
            pending = list(self._pending)
        for wait in pending:
            self._try(wait)

    def _try(self, wait: _Wait) -> None:
        if wait.future.done() or wait.future.cancelled() or _complete(wait):
            with self._lock:
                if wait in self._pending:
                    self._pending.remove(wait)

    def _watch_if_needed(self) -> None:
        if self._watcher is not None:
            return
        if any(self._is_fed_natively or wait.deadline is not None for wait in self._pending):
            self._watcher = threading.Thread(
                target=_watch, args=(weakref.ref(self), self._buffer), name="tf2_ros waits", daemon=True
            )
            _watchers.add(self._watcher)
            self._watcher.start()

    def turn(self) -> tuple[int, int] | None:
        """One round of the watcher: which changes it has seen, and how long it may sleep; None if it may end."""
        seen = self._buffer.changes
        self.settle()
        with self._lock:
            if not self._pending or _exiting.is_set():
                self._watcher = None
                return None
            deadlines = [wait.deadline for wait in self._pending if wait.deadline is not None]
        sleep = min([_PATIENCE, *(deadline - time.monotonic_ns() for deadline in deadlines)])
        return seen, max(sleep, 0)


def _watch(reference: weakref.ref[Waits], buffer: coframe.Buffer) -> None:
    """Look after the waits of a buffer; asleep, it does not keep them alive."""
    while True:
        waits = reference()
        nap = waits.turn() if waits is not None else None
        del waits
        if nap is None:
            return
        buffer.wait_for_change(*nap)


def _complete(wait: _Wait) -> bool:
    """Complete the future if the transform is known, or the time is over."""
    try:
        result = wait.attempt()
    except TransformException as error:
        if wait.deadline is None or time.monotonic_ns() < wait.deadline:
            return False
        if not wait.future.done():
            wait.future.set_exception(error)
        return True
    if not wait.future.done():
        wait.future.set_result(result)
    return True
