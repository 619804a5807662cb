# SPDX-License-Identifier: Apache-2.0
"""A filter that sorts messages by their stamps."""

from __future__ import annotations

import heapq
import itertools
import threading
from typing import TYPE_CHECKING, Any

from message_filters._filters import SimpleFilter
from message_filters._stamps import as_nanoseconds, header_nanoseconds

if TYPE_CHECKING:
    from rclpy.duration import Duration
    from rclpy.node import Node

_S_TO_NS = 1_000_000_000


class TimeSequencer(SimpleFilter):
    """A filter that passes messages in the order of their stamps, each a fixed time after its stamp.

    A message with an earlier stamp than that of a message that was already passed on is dropped.

    Args:
        input_filter: The filter whose messages are sorted. None: `connectInput` or `add` are called later.
        delay: Time from the stamp of a message until it is passed on: a `Duration` or seconds.
        update_rate: Period of the check for messages that are due: a `Duration` or seconds.
        queue_size: Number of messages to keep. If there are more, those with the earliest stamps are dropped.
        node: Node whose clock and timer are used.
    """

    def __init__(
        self,
        input_filter: SimpleFilter | None,
        delay: Duration | float,
        update_rate: Duration | float,
        queue_size: int,
        node: Node,
    ) -> None:
        super().__init__()
        self.node = node
        self.queue_size = queue_size
        self._delay = as_nanoseconds(delay)
        self._lock = threading.Lock()
        self._queue: list[tuple[int, int, Any]] = []
        self._count = itertools.count()  # keeps the order of arrival of messages with equal stamps
        self._last: int | None = None
        self._timer = node.create_timer(as_nanoseconds(update_rate) / _S_TO_NS, self._dispatch)
        if input_filter is not None:
            self.connectInput(input_filter)

    def connectInput(self, f: SimpleFilter) -> None:
        """Sort the messages of this filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Add a message."""
        stamp = header_nanoseconds(msg)
        with self._lock:
            if self._last is not None and stamp < self._last:
                return
            heapq.heappush(self._queue, (stamp, next(self._count), msg))
            if len(self._queue) > self.queue_size:
                heapq.heappop(self._queue)

    def _dispatch(self) -> None:
        due = self.node.get_clock().now().nanoseconds - self._delay
        ready = []
        with self._lock:
            if self._last is not None and due < self._last:  # The clock has jumped back.
                self._queue.clear()
                self._last = None
            while self._queue and self._queue[0][0] <= due:
                self._last, _, message = heapq.heappop(self._queue)
                ready.append(message)
        for message in ready:
            self.signalMessage(message)
