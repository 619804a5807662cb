# SPDX-License-Identifier: Apache-2.0
"""A filter that keeps the latest messages."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from message_filters._filters import SimpleFilter
from message_filters._stamps import ArrivalClock, header_stamp, warn_headerless

if TYPE_CHECKING:
    from rclpy.time import Time


class Cache(SimpleFilter):
    """A filter that keeps the messages that arrived last, and lets all messages through.

    As upstream, messages are kept in the order of their arrival: "oldest" and "newest" are the first and the last that
    arrived, which are also those with the earliest and latest stamp if a topic is in order.

    Args:
        f: Filter to which the cache is connected. None: `connectInput` or `add` are called later.
        cache_size: Number of messages to keep.
        allow_headerless: Whether to use the time of arrival as stamp of messages without a header. Otherwise, they are
            ignored with a warning.

    Attributes:
        cache_msgs: The messages.
        cache_times: The stamps of the messages.
    """

    def __init__(self, f: SimpleFilter | None, cache_size: int = 1, allow_headerless: bool = False) -> None:
        super().__init__()
        self.cache_size = cache_size
        self.allow_headerless = allow_headerless
        self.cache_msgs: list[Any] = []
        self.cache_times: list[Time] = []
        self.__clock = ArrivalClock([f])
        if f is not None:
            self.connectInput(f)

    def connectInput(self, f: SimpleFilter) -> None:
        """Store the messages of this filter."""
        self.__clock = ArrivalClock([f])
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Store a message and pass it on."""
        stamp = header_stamp(msg)
        if stamp is None:
            if not self.allow_headerless:
                warn_headerless("message_filters_cache")
                return
            stamp = self.__clock.now()
        self.cache_msgs.append(msg)
        self.cache_times.append(stamp)
        if len(self.cache_msgs) > self.cache_size:
            del self.cache_msgs[0], self.cache_times[0]
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Time, to_stamp: Time) -> list[Any]:
        """Return the messages with stamps from `from_stamp` to `to_stamp`, both inclusive."""
        assert from_stamp <= to_stamp
        return [msg for msg, stamp in self.__stamped() if from_stamp <= stamp <= to_stamp]

    def getElemAfterTime(self, stamp: Time) -> Any:
        """Return the oldest message with this stamp or a later one, or None."""
        return next((msg for msg, time in self.__stamped() if time >= stamp), None)

    def getElemBeforeTime(self, stamp: Time) -> Any:
        """Return the newest message with this stamp or an earlier one, or None."""
        return next((msg for msg, time in reversed(self.__stamped()) if time <= stamp), None)

    def getLastestTime(self) -> Time | None:
        """Return the stamp of the newest message, or None. The misspelled name is upstream's."""
        return self.cache_times[-1] if self.cache_times else None

    def getLatestTime(self) -> Time | None:
        """Return the stamp of the newest message, or None."""
        return self.getLastestTime()

    def getOldestTime(self) -> Time | None:
        """Return the stamp of the oldest message, or None."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> Any:
        """Return the oldest message that has the stamp of the newest one or a later stamp, or None."""
        latest = self.getLastestTime()
        return None if latest is None else self.getElemAfterTime(latest)

    def __stamped(self) -> list[tuple[Any, Time]]:
        return list(zip(self.cache_msgs, self.cache_times, strict=True))
