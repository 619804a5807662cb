# SPDX-License-Identifier: Apache-2.0
"""Queue of the messages that wait for transforms in a message filter."""

import threading
from collections import OrderedDict, deque
from dataclasses import dataclass
from enum import IntEnum
from itertools import takewhile
from typing import Any, NamedTuple

from rclpy.task import Future  # noqa: TC001 - a name of the module


class FilterFailureReason(IntEnum):
    """Reason for dropping a message. Names and numbers are the same as in C++, which has no `TimedOut`."""

    Unknown = 0  # The wait for its transform was cancelled.
    OutTheBack = 1  # It is older than all data in the buffer, so its transform will never be available.
    EmptyFrameID = 2  # The frame_id of its header is empty.
    NoTransformFound = 3  # The frame_id of its header is not a valid frame name.
    QueueFull = 4  # It was the oldest message in a full queue.
    TimedOut = 5  # Its transform was not available before the timeout.


class FilterStatistics(NamedTuple):
    """Message counts of a filter: received == passed + sum(dropped.values()) + cleared + waiting.

    Attributes:
        received: Number of received messages.
        passed: Number of messages passed to the callbacks.
        dropped: Number of dropped messages by reason.
        cleared: Number of messages removed by `clear()` or `destroy()`.
        waiting: Number of messages that wait for a transform or for the executor.
    """

    received: int
    passed: int
    dropped: dict[FilterFailureReason, int]
    cleared: int
    waiting: int


@dataclass(eq=False)
class PendingMessage:
    """A message that waits for a transform.

    Attributes:
        number: Number of messages received before this one.
        message: The message to pass to the callbacks of the filter.
        frame: Frame of its header.
        stamp: Stamp of its header in nanoseconds.
        deadline: Steady time in nanoseconds at which the wait times out. None: never.
        future: Future of the transform that it waits for.
    """

    number: int
    message: Any
    frame: str
    stamp: int
    deadline: int | None
    future: "Future[Any] | None" = None


class Outcome(NamedTuple):
    """A message for the callbacks, with a reason if it was dropped."""

    message: Any
    reason: FilterFailureReason | None = None
    explanation: str = ""


class MessageQueue:
    """Queue of pending messages in the order of their arrival, and of outcomes for the callbacks.

    The queue is thread-safe. Each message is finished once, by the first thread that can finish it.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._pending: OrderedDict[int, PendingMessage] = OrderedDict()
        self._outcomes: deque[Outcome] = deque()
        self._received = self._passed = self._cleared = 0
        self._dropped = dict.fromkeys(FilterFailureReason, 0)
        self._is_closed = False

    def add(self, message: Any, frame: str, stamp: int, deadline: int | None) -> PendingMessage | None:
        """Add a message. Return None if the queue is closed."""
        with self._lock:
            if self._is_closed:
                return None
            pending = PendingMessage(self._received, message, frame, stamp, deadline)
            self._received += 1
            self._pending[pending.number] = pending
        return pending

    def finish(self, pending: PendingMessage, reason: FilterFailureReason | None = None, explanation: str = "") -> bool:
        """Move a message to the outcomes. Return False if it is finished already."""
        with self._lock:
            if self._pending.pop(pending.number, None) is None:
                return False
            if reason is not None:
                self._dropped[reason] += 1
            self._outcomes.append(Outcome(pending.message, reason, explanation))
        if pending.future is not None:
            pending.future.cancel()
        return True

    def set_future(self, pending: PendingMessage, future: "Future[Any]") -> None:
        """Set the future that a message waits for, and cancel its previous future."""
        with self._lock:
            obsolete = future
            if pending.number in self._pending:
                pending.future, obsolete = future, pending.future
        if obsolete is not None:
            obsolete.cancel()

    def pending_for(self, number: int, future: "Future[Any]") -> PendingMessage | None:
        """Return the message with this number if it still waits for this future, otherwise None."""
        with self._lock:
            pending = self._pending.get(number)
        return pending if pending is not None and pending.future is future else None

    def all(self) -> list[PendingMessage]:
        """Return all pending messages."""
        with self._lock:
            return list(self._pending.values())

    def earlier_of_same_frame(self, pending: PendingMessage) -> list[PendingMessage]:
        """Return the earlier messages of the same frame whose stamps are not newer, which are delivered first."""
        with self._lock:
            earlier = takewhile(lambda other: other is not pending, self._pending.values())
            return [other for other in earlier if other.frame == pending.frame and other.stamp <= pending.stamp]

    def oldest_if_longer_than(self, size: int) -> PendingMessage | None:
        """Return the oldest message if more than `size` messages are pending, otherwise None."""
        with self._lock:
            return next(iter(self._pending.values())) if len(self._pending) > size else None

    def take_outcome(self) -> Outcome | None:
        """Return and remove the next outcome, or None if there is none."""
        with self._lock:
            if not self._outcomes:
                return None
            outcome = self._outcomes.popleft()
            self._passed += outcome.reason is None
            return outcome

    def has_outcomes(self) -> bool:
        """Return whether there are outcomes for the callbacks."""
        return bool(self._outcomes)

    def clear(self) -> None:
        """Remove all messages that wait for transforms or callbacks. Dropped messages are still reported."""
        with self._lock:
            removed, self._pending = self._pending, OrderedDict()
            drops = [outcome for outcome in self._outcomes if outcome.reason is not None]
            self._cleared += len(removed) + len(self._outcomes) - len(drops)
            self._outcomes = deque(drops)
        for pending in removed.values():
            if pending.future is not None:
                pending.future.cancel()

    def close(self) -> None:
        """Remove all messages and accept no new ones."""
        with self._lock:
            self._is_closed = True
        self.clear()

    def statistics(self) -> FilterStatistics:
        """Return the message counts."""
        with self._lock:
            pending = len(self._pending) + sum(outcome.reason is None for outcome in self._outcomes)
            return FilterStatistics(self._received, self._passed, dict(self._dropped), self._cleared, pending)
