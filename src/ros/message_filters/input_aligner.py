# SPDX-License-Identifier: Apache-2.0
"""A filter that passes on the messages on several topics in the order of their stamps."""

from __future__ import annotations

import threading
from collections import deque
from typing import TYPE_CHECKING, Any

from message_filters._filters import SimpleFilter
from message_filters._stamps import as_nanoseconds, header_nanoseconds

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.duration import Duration
    from rclpy.node import Node

__all__ = ["InputAligner"]

_S_TO_NS = 1_000_000_000


class _Input:
    """The queued messages of one filter, its callbacks, and its period in nanoseconds, or 0 if unknown."""

    def __init__(self) -> None:
        self.waiting: deque[tuple[int, Any]] = deque()
        self.output = SimpleFilter()
        self.period = 0
        self.last = -1

    def next_stamp(self) -> int:
        """Return the stamp of the first message that waits, or the earliest stamp that the next one can have."""
        if self.waiting:
            return self.waiting[0][0]
        return self.last + max(self.period, 1) if self.last >= 0 else 0


class InputAligner:
    """Passes on the messages of several filters, of any types, in the order of their stamps.

    A message waits until no other filter can deliver one with an earlier stamp, which the periods say, but at most for
    the timeout.

    Args:
        timeout: Limit of the waiting, measured by the stamps of the messages: a `Duration` or seconds.
        *filters: The filters whose messages are passed on.
    """

    def __init__(self, timeout: Duration | float, *filters: SimpleFilter) -> None:
        self._timeout = as_nanoseconds(timeout)
        self._lock = threading.RLock()
        self._inputs = [_Input() for _ in filters]
        self._newest = 0
        self._timer: Any = None
        self.input_connections = [filter_.registerCallback(self.add, index) for index, filter_ in enumerate(filters)]

    def setInputPeriod(self, index: int, period: Duration | float) -> None:
        """Set the expected time between two messages of a filter, a `Duration` or seconds."""
        self._inputs[index].period = as_nanoseconds(period)

    def registerCallback(self, index: int, cb: Callable[..., Any], *args: Any) -> int:
        """Add a callback for the messages of the filter with an index. See `SimpleFilter.registerCallback`."""
        return self._inputs[index].output.registerCallback(cb, *args)

    def setupDispatchTimer(self, node: Node, update_rate: Duration | float) -> None:
        """Call `dispatchMessages` periodically, a `Duration` or seconds, and not with each message."""
        self._timer = node.create_timer(as_nanoseconds(update_rate) / _S_TO_NS, self.dispatchMessages)

    def add(self, msg: Any, index: int) -> None:
        """Add a message of the filter with an index; one that is earlier than a message passed on before is dropped."""
        stamp = header_nanoseconds(msg)
        with self._lock:
            entry = self._inputs[index]
            if entry.waiting and stamp < entry.waiting[-1][0]:
                entry.waiting = deque(sorted([*entry.waiting, (stamp, msg)], key=lambda waiting: waiting[0]))
            elif stamp > entry.last:
                entry.waiting.append((stamp, msg))
            self._newest = max(self._newest, stamp)
        if self._timer is None:
            self.dispatchMessages()

    def dispatchMessages(self) -> None:
        """Pass on all messages that need not wait any longer."""
        with self._lock:
            while (entry := self._next()) is not None:
                entry.last, message = entry.waiting.popleft()
                entry.output.signalMessage(message)

    def _next(self) -> _Input | None:
        waiting = [entry for entry in self._inputs if entry.waiting]
        if not waiting:
            return None
        first = min(waiting, key=_Input.next_stamp)
        stamp = first.next_stamp()
        is_first = all(entry is first or stamp <= entry.next_stamp() for entry in self._inputs)
        return first if is_first or self._newest - stamp >= self._timeout else None
