# SPDX-License-Identifier: Apache-2.0
"""Filters that combine the messages on several topics by their stamps."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from message_filters._filters import SimpleFilter
from message_filters._matching import first_match
from message_filters._stamps import ArrivalClock, as_nanoseconds, header_nanoseconds, header_stamp, warn_headerless
from rclpy.duration import Duration

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


class TimeSynchronizer(SimpleFilter):
    """A filter that lets the messages of several filters through together if their stamps are equal.

    Args:
        fs: The filters. The callbacks get one message of each, in this order.
        queue_size: Number of messages to keep for each filter. If there are more, those with the earliest stamps are
            dropped.

    Attributes:
        queues: For each filter, the messages that wait for others, by stamp in nanoseconds.
        lock: Lock that is held while messages are added and callbacks run.
    """

    def __init__(self, fs: Iterable[SimpleFilter], queue_size: int) -> None:
        super().__init__()
        # A callback may cause another message of the same thread, so the lock is reentrant.
        self.lock = threading.RLock()
        self.queue_size = queue_size
        self.connectInput(fs)

    def connectInput(self, fs: Iterable[SimpleFilter]) -> None:
        """Combine the messages of these filters."""
        filters = list(fs)
        self._arrivals = ArrivalClock(filters)
        self.queues: list[dict[int, Any]] = [{} for _ in filters]
        self.input_connections = [
            filter_.registerCallback(self.add, queue, index)
            for index, (filter_, queue) in enumerate(zip(filters, self.queues, strict=True))
        ]

    def add(self, msg: Any, my_queue: dict[int, Any], my_queue_index: int | None = None) -> None:
        """Add a message of one filter, and pass on all sets of messages with equal stamps.

        Args:
            msg: The message.
            my_queue: The element of `queues` for this filter.
            my_queue_index: The index of `my_queue`.
        """
        del my_queue_index
        stamp = header_nanoseconds(msg)
        with self.lock:
            self._arrivals.clear_after_jump_back(self.queues)
            _store(msg, stamp, my_queue, self.queue_size)
            # All other stamps were checked when their last message was added.
            if all(stamp in queue for queue in self.queues):
                self.signalMessage(*[queue.pop(stamp) for queue in self.queues])


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """A filter that lets the messages of several filters through together if their stamps are close.

    Each new message is combined with one waiting message of each other filter. All stamps must be less than `slop`
    apart. Of several combinations, the first filter's message is as close as possible to the new one, then the second
    filter's, and so on.

    Args:
        fs: The filters. The callbacks get one message of each, in this order.
        queue_size: Number of messages to keep for each filter.
        slop: Limit of the difference between the stamps in seconds.
        allow_headerless: Whether to use the time of arrival as stamp of messages without a header. Otherwise, they are
            ignored with a warning.
        sync_arrival_time: Whether to use the time of arrival as stamp of all messages.
        offsets: For each filter, a `Duration` or seconds that are added to its stamps before they are compared. None:
            no offsets.
    """

    def __init__(
        self,
        fs: Iterable[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
        sync_arrival_time: bool = False,
        *,
        offsets: Sequence[Duration | float] | None = None,
    ) -> None:
        super().__init__(fs, queue_size)
        self._offsets = [0] * len(self.queues) if offsets is None else [as_nanoseconds(each) for each in offsets]
        if len(self._offsets) != len(self.queues):
            raise ValueError(f"{len(self._offsets)} offsets for {len(self.queues)} filters")
        self.slop = Duration(seconds=slop)
        self.allow_headerless = allow_headerless
        self.sync_arrival_time = sync_arrival_time

    def add(self, msg: Any, my_queue: dict[int, Any], my_queue_index: int | None = None) -> None:
        """Add a message of one filter, and pass on a set of messages with close stamps if there is one.

        Args:
            msg: The message.
            my_queue: The element of `queues` for this filter.
            my_queue_index: The index of `my_queue`. None: it is searched.
        """
        stamp = None if self.sync_arrival_time else header_stamp(msg)
        if stamp is None:
            if not (self.allow_headerless or self.sync_arrival_time):
                warn_headerless("message_filters_approx")
                return
            stamp = self._arrivals.now()
        index = my_queue_index
        if index is None:
            index = next(number for number, queue in enumerate(self.queues) if queue is my_queue)
        new = stamp.nanoseconds + self._offsets[index]
        with self.lock:
            self._arrivals.clear_after_jump_back(self.queues)
            _store(msg, new, my_queue, self.queue_size)
            if new not in my_queue or not all(self.queues):
                return
            others = first_match(new, self.queues[:index] + self.queues[index + 1 :], self.slop.nanoseconds)
            if others is not None:
                stamps = [*others[:index], new, *others[index:]]
                self.signalMessage(*[queue.pop(stamp) for queue, stamp in zip(self.queues, stamps, strict=True)])


def _store(message: Any, stamp: int, queue: dict[int, Any], queue_size: int) -> None:
    queue[stamp] = message
    while len(queue) > queue_size:
        del queue[min(queue)]
