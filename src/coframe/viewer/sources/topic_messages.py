# SPDX-License-Identifier: Apache-2.0
"""The messages on one topic, which displays look up by time."""

from __future__ import annotations

import itertools
import threading
import time
from bisect import bisect_right
from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from coframe.viewer.sources.adaptive_subscription import AdaptiveSubscription

__all__ = ["LiveMessages", "StampedMessage", "TopicMessages"]

_PERIOD_WEIGHT = 0.2  # of the last interval between messages, if it is shorter than the usual one


class StampedMessage(NamedTuple):
    """A message of a topic.

    Attributes:
        key: A number that increases from message to message.
        time: The position on the timeline in nanoseconds.
        read: Return the message; raises ValueError if its bytes do not match its type.
    """

    key: int
    time: int
    read: Callable[[], Any]


class TopicMessages(Protocol):
    """The messages on one topic. Thread-safe."""

    type: str

    def frame(self, name: str) -> str:
        """Return the buffer's name for a frame in a message."""

    def pending(self) -> bool:
        """Return whether the next lookup has to read new messages first, which may take a while."""

    def at(self, time: int) -> StampedMessage | None:
        """Return the last message at or before a time in nanoseconds; 0 selects the newest message."""

    def before(self, time: int, count: int) -> list[StampedMessage]:
        """Return up to `count` messages at or before a time, oldest first; 0 selects the newest messages."""

    def after(self, key: int, last: int) -> list[StampedMessage]:
        """Return the known messages with keys above `key` and up to `last`, oldest first."""

    def times(self) -> NDArray[np.int64]:
        """Return the positions of all messages on the timeline, in order."""

    @property
    def shortfall(self) -> str:
        """What the user requests and a publisher does not offer, or ""."""

    def close(self) -> None:
        """Release the resources of the topic."""


class _Stored(NamedTuple):
    key: int
    time: int
    data: bytes


class LiveMessages:
    """The latest messages on a topic, kept as bytes until they are displayed.

    Args:
        subscription: The subscription to the topic.
        ros_type: The type of the messages.
        keep: The time for which messages are kept, in nanoseconds; the newest message is always kept.
        frame: Return the buffer's name for a frame in a message.
        now: Return the time of messages without a stamp, in nanoseconds.

    Attributes:
        type: The type of the messages.
        received_at: When the last message was received, on the monotonic clock in nanoseconds; 0 before the first one.
        period: The usual interval between messages in nanoseconds; 0 while it is unknown.
    """

    MAX_BYTES = 64 << 20
    MAX_MESSAGES = 4000

    def __init__(
        self,
        subscription: AdaptiveSubscription,
        ros_type: str,
        keep: int,
        frame: Callable[[str], str],
        now: Callable[[], int] = time.time_ns,
    ) -> None:
        # Imported here because only message displays need the message classes.
        from coframe.messages import deserialize, find  # noqa: PLC0415
        from coframe.messages.header_peek import stamp_reader  # noqa: PLC0415

        self.type = ros_type
        self._subscription = subscription
        self._class = find(ros_type)
        self._deserialize = deserialize
        self._stamp_reader = stamp_reader(ros_type)
        self._kept_count = keep
        self._frame = frame
        self._now = now
        self.received_at, self.period = 0, 0.0
        self._stored_messages: deque[_Stored] = deque()
        self._bytes = 0
        self._keys = itertools.count(1)
        self._take_lock = threading.Lock()  # Held longer than the other lock, because messages may be large.
        self._lock = threading.Lock()

    def frame(self, name: str) -> str:
        """Return the buffer's name for a frame in a message."""
        return self._frame(name)

    def pending(self) -> bool:
        """Return whether messages have arrived that are not stored yet."""
        return self._subscription.pending()

    def at(self, time: int) -> StampedMessage | None:
        """Return the last message at or before a time in nanoseconds; 0 selects the newest message."""
        self._take()
        with self._lock:
            if not self._stored_messages:
                return None
            index = self._index_after(time) - 1
            return None if index < 0 else self._message(self._stored_messages[index])

    def before(self, time: int, count: int) -> list[StampedMessage]:
        """Return up to `count` messages at or before a time, oldest first; 0 selects the newest messages."""
        self._take()
        with self._lock:
            end = self._index_after(time)
            return [self._message(one) for one in itertools.islice(self._stored_messages, max(0, end - count), end)]

    def after(self, key: int, last: int) -> list[StampedMessage]:
        """Return the kept messages with keys above `key` and up to `last`, oldest first."""
        self._take()
        with self._lock:
            newer = itertools.takewhile(lambda stored: stored.key > key, reversed(self._stored_messages))
            return [self._message(stored) for stored in reversed([one for one in newer if one.key <= last])]

    def times(self) -> NDArray[np.int64]:
        """Return the positions of all messages on the timeline, in order."""
        self._take()
        with self._lock:
            return np.array([stored.time for stored in self._stored_messages], np.int64)

    @property
    def shortfall(self) -> str:
        """What the user requests and a publisher does not offer, or ""."""
        return self._subscription.shortfall

    def close(self) -> None:
        """Unsubscribe from the topic."""
        self._subscription.close()

    def _take(self) -> None:
        if not self._subscription.pending():
            return
        with self._take_lock:
            samples = self._subscription.take()
            if samples:
                self._note_arrival(len(samples))
            with self._lock:
                for sample in samples:
                    self._store(sample.data)

    def _note_arrival(self, count: int) -> None:
        now = time.monotonic_ns()
        if self.received_at:
            interval = (now - self.received_at) / count
            # Between the longest interval and the last one, so that one long interval is forgotten.
            self.period = max(interval, self.period + (interval - self.period) * _PERIOD_WEIGHT)
        self.received_at = now

    def _store(self, data: bytes) -> None:
        stamp = self._stamp_reader.stamp(data) if self._stamp_reader else None
        if stamp is None or stamp <= 0:
            stamp = self._now()
        # Times must not decrease: a late message is placed at the newest time.
        newest = self._stored_messages[-1].time if self._stored_messages else stamp
        if stamp < newest - self._kept_count:  # Time jumped back, for example because a simulation was restarted.
            self._stored_messages.clear()
            self._bytes = 0
            newest = stamp
        self._stored_messages.append(_Stored(next(self._keys), max(stamp, newest), data))
        self._bytes += len(data)
        self._drop_old()

    def _drop_old(self) -> None:
        newest = self._stored_messages[-1].time
        while len(self._stored_messages) > 1 and (
            self._stored_messages[0].time < newest - self._kept_count
            or self._bytes > self.MAX_BYTES
            or len(self._stored_messages) > self.MAX_MESSAGES
        ):
            self._bytes -= len(self._stored_messages.popleft().data)

    def _index_after(self, time: int) -> int:
        if time == 0:
            return len(self._stored_messages)
        return bisect_right(self._stored_messages, time, key=lambda stored: stored.time)

    def _message(self, stored: _Stored) -> StampedMessage:
        return StampedMessage(stored.key, stored.time, lambda: self._deserialize(stored.data, self._class))
