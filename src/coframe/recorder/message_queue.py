"""What was received and is not yet on the disk: a queue with a limit, between the wire and a disk that may be slow."""

from __future__ import annotations

import threading
import time
from collections import Counter, deque
from typing import NamedTuple

__all__ = ["MessageQueue", "ReceivedMessage", "Source"]

_OVERHEAD = 200  # bytes of a message in Python besides its own


class Source(NamedTuple):
    """Where messages come from.

    Attributes:
        topic: With its slash.
        type: Of ROS.
        latched: Whether late joiners are given its last messages, as those of /tf_static.
    """

    topic: str
    type: str
    latched: bool


class ReceivedMessage(NamedTuple):
    """A message. Times are nanoseconds."""

    source: Source
    data: bytes
    received: int
    published: int
    publisher: int


class MessageQueue:
    """A queue of messages. When it is full, the oldest message makes room, and is counted.

    Latched messages stay, for they are not said again: they go only if they alone fill the queue.

    Args:
        limit: Bytes that it may hold.
    """

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._changed = threading.Condition()
        self._messages: deque[ReceivedMessage] = deque()
        self._latched: deque[ReceivedMessage] = deque()
        self._closed = False
        self.size = 0  # bytes
        self.dropped: Counter[str] = Counter()  # by topic

    def put(self, message: ReceivedMessage) -> None:
        """Takes a message in, without waiting."""
        with self._changed:
            (self._latched if message.source.latched else self._messages).append(message)
            self.size += _size(message)
            while self.size > self._limit and len(self._messages) + len(self._latched) > 1:
                oldest = (self._messages or self._latched).popleft()
                self.size -= _size(oldest)
                self.dropped[oldest.source.topic] += 1
            self._changed.notify()

    def take(self, timeout: float, limit: int) -> list[ReceivedMessage]:
        """The oldest messages in the order in which they were received; none after `timeout` seconds, or once closed.

        Args:
            timeout: How long to wait for the first one.
            limit: Of how many bytes, about.
        """
        deadline = time.monotonic() + timeout
        with self._changed:
            while not (self._messages or self._latched or self._closed):
                left = deadline - time.monotonic()
                if left <= 0:
                    break
                self._changed.wait(left)
            taken: list[ReceivedMessage] = []
            while limit > 0 and (queue := self._older()):
                taken.append(queue.popleft())
                self.size -= _size(taken[-1])
                limit -= _size(taken[-1])
            return taken

    @property
    def is_done(self) -> bool:
        """Whether it is closed and empty."""
        with self._changed:
            return self._closed and not (self._messages or self._latched)

    def close(self) -> None:
        """Nothing more will come."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def _older(self) -> deque[ReceivedMessage]:
        """The queue with the older message in front; an empty one if there is none."""
        if not self._latched or not self._messages:
            return self._latched or self._messages
        return self._latched if self._latched[0].received <= self._messages[0].received else self._messages


def _size(message: ReceivedMessage) -> int:
    return len(message.data) + _OVERHEAD
