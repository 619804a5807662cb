"""The messages that wait in a filter, and what becomes of them."""

import threading
from collections import OrderedDict, deque
from dataclasses import dataclass
from enum import IntEnum
from itertools import takewhile
from typing import Any, NamedTuple

from rclpy.task import Future


class FilterFailureReason(IntEnum):
    """Why a message did not get through. Names and numbers are C++'s; C++ has no `TimedOut`."""

    Unknown = 0  # somebody cancelled the wait for its transform
    OutTheBack = 1  # it is older than everything the buffer has, so its transform will never come
    EmptyFrameID = 2  # its header names no frame
    NoTransformFound = 3  # its header names a frame that cannot exist
    QueueFull = 4  # it was the oldest of more messages than may wait
    TimedOut = 5  # its time to wait was over


class FilterStatistics(NamedTuple):
    """What became of a filter's messages: received == passed + sum(dropped.values()) + cleared + waiting.

    Attributes:
        received: Messages that came in.
        passed: Those given to the callbacks.
        dropped: Those that were dropped, by reason.
        cleared: Those forgotten by `clear()` or `destroy()`.
        waiting: Those that wait for a transform, or have it and wait for the executor.
    """

    received: int
    passed: int
    dropped: dict[FilterFailureReason, int]
    cleared: int
    waiting: int


@dataclass(eq=False)
class Waiting:
    """A message that lacks a transform, as far as is known.

    Attributes:
        number: How many came before it.
        message: The message.
        frame: The frame of its header.
        stamp: Nanoseconds of its header.
        deadline: When it is given up, in nanoseconds of the steady clock; None: never.
        future: What it waits for.
    """

    number: int
    message: Any
    frame: str
    stamp: int
    deadline: int | None
    future: Future[Any] | None = None


class Outcome(NamedTuple):
    """A message that the callbacks have to be told of; with a reason if it was dropped."""

    message: Any
    reason: FilterFailureReason | None = None
    explanation: str = ""


class MessageQueue:
    """Messages that wait, in the order in which they came, and outcomes that wait for the callbacks.

    For any number of threads: each message leaves once, whoever sees first that it can.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: OrderedDict[int, Waiting] = OrderedDict()
        self._outcomes: deque[Outcome] = deque()
        self._received = self._passed = self._cleared = 0
        self._dropped = dict.fromkeys(FilterFailureReason, 0)
        self._is_closed = False

    def enter(self, message: Any, frame: str, stamp: int, deadline: int | None) -> Waiting | None:
        """Take a message in; None: the queue is closed."""
        with self._lock:
            if self._is_closed:
                return None
            waiting = Waiting(self._received, message, frame, stamp, deadline)
            self._received += 1
            self._waiting[waiting.number] = waiting
        return waiting

    def leave(self, waiting: Waiting, reason: FilterFailureReason | None = None, explanation: str = "") -> bool:
        """Let a message out; False: it is out already."""
        with self._lock:
            if self._waiting.pop(waiting.number, None) is None:
                return False
            if reason is not None:
                self._dropped[reason] += 1
            self._outcomes.append(Outcome(waiting.message, reason, explanation))
        if waiting.future is not None:
            waiting.future.cancel()
        return True

    def wait_for(self, waiting: Waiting, future: Future[Any]) -> None:
        """Note what a message waits for from now on; what it waited for before is cancelled."""
        with self._lock:
            obsolete = future
            if waiting.number in self._waiting:
                waiting.future, obsolete = future, waiting.future
        if obsolete is not None:
            obsolete.cancel()

    def waits_for(self, number: int, future: Future[Any]) -> Waiting | None:
        """The message with that number, if it still waits for that future."""
        with self._lock:
            waiting = self._waiting.get(number)
        return waiting if waiting is not None and waiting.future is future else None

    def all(self) -> list[Waiting]:
        """All that wait."""
        with self._lock:
            return list(self._waiting.values())

    def elders(self, waiting: Waiting) -> list[Waiting]:
        """Those that go first if they can: of the same frame, come before it, and no younger."""
        with self._lock:
            earlier = takewhile(lambda other: other is not waiting, self._waiting.values())
            return [other for other in earlier if other.frame == waiting.frame and other.stamp <= waiting.stamp]

    def oldest_beyond(self, size: int) -> Waiting | None:
        """The one that came first, if more than `size` wait."""
        with self._lock:
            return next(iter(self._waiting.values())) if len(self._waiting) > size else None

    def take(self) -> Outcome | None:
        """The next outcome for the callbacks, if there is one."""
        with self._lock:
            if not self._outcomes:
                return None
            outcome = self._outcomes.popleft()
            self._passed += outcome.reason is None
            return outcome

    def has_outcomes(self) -> bool:
        """Return whether there is an outcome for the callbacks."""
        return bool(self._outcomes)

    def clear(self) -> None:
        """Forget all that wait, for transforms or for the callbacks; drops are still told."""
        with self._lock:
            forgotten, self._waiting = self._waiting, OrderedDict()
            drops = [outcome for outcome in self._outcomes if outcome.reason is not None]
            self._cleared += len(forgotten) + len(self._outcomes) - len(drops)
            self._outcomes = deque(drops)
        for waiting in forgotten.values():
            if waiting.future is not None:
                waiting.future.cancel()

    def close(self) -> None:
        """Forget all that wait, and take no more in."""
        with self._lock:
            self._is_closed = True
        self.clear()

    def statistics(self) -> FilterStatistics:
        """What became of the messages so far."""
        with self._lock:
            waiting = len(self._waiting) + sum(outcome.reason is None for outcome in self._outcomes)
            return FilterStatistics(self._received, self._passed, dict(self._dropped), self._cleared, waiting)
