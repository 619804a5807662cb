# SPDX-License-Identifier: Apache-2.0
"""The queue of received messages that are not yet on disk. Its size is limited, because the disk may be slow."""

from __future__ import annotations

import threading
import time
from collections import Counter, deque
from typing import NamedTuple

__all__ = ["MessageQueue", "MessageSource", "ReceivedMessage"]

_OVERHEAD = 200  # bytes of Python overhead per message


class MessageSource(NamedTuple):
    """Where a message came from.

    Attributes:
        topic: The fully qualified name of the topic.
        type: The ROS type.
        latched: Whether the publishers are transient local, like those of /tf_static.
    """

    topic: str
    type: str
    latched: bool


class ReceivedMessage(NamedTuple):
    """A received message.

    Attributes:
        source: The source of the message.
        data: The serialized message.
        received: The time of arrival, in nanoseconds since 1970.
        published: The time of publication, in nanoseconds since 1970.
        publisher: The handle of the publisher.
    """

    source: MessageSource
    data: bytes
    received: int
    published: int
    publisher: int


class MessageQueue:
    """A queue of messages with a limited size. If it is full, the oldest message is dropped and counted.

    Latched messages are published only once, so they are dropped only if no other message is left.

    Args:
        limit: The size limit in bytes.

    Attributes:
        size: The current size in bytes.
        dropped: The number of dropped messages by topic.
    """

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._condition = threading.Condition()
        self._messages: deque[ReceivedMessage] = deque()
        self._latched_messages: deque[ReceivedMessage] = deque()
        self._closed = False
        self.size = 0
        self.dropped: Counter[str] = Counter()

    def add_message(self, message: ReceivedMessage) -> None:
        """Add a message without waiting."""
        with self._condition:
            (self._latched_messages if message.source.latched else self._messages).append(message)
            self.size += _size(message)
            while self.size > self._limit and len(self._messages) + len(self._latched_messages) > 1:
                oldest = (self._messages or self._latched_messages).popleft()
                self.size -= _size(oldest)
                self.dropped[oldest.source.topic] += 1
            self._condition.notify()

    def take(self, timeout: float, limit: int) -> list[ReceivedMessage]:
        """Remove and return the oldest messages, in the order in which they were received.

        Args:
            timeout: How long to wait for the first message, in seconds.
            limit: The approximate number of bytes to return.

        Returns:
            The messages, or none after the timeout or if the queue is closed and empty.
        """
        deadline = time.monotonic() + timeout
        with self._condition:
            while not (self._messages or self._latched_messages or self._closed):
                left = deadline - time.monotonic()
                if left <= 0:
                    break
                self._condition.wait(left)
            messages: list[ReceivedMessage] = []
            while limit > 0 and (queue := self._queue_with_oldest()):
                messages.append(queue.popleft())
                self.size -= _size(messages[-1])
                limit -= _size(messages[-1])
            return messages

    @property
    def is_done(self) -> bool:
        """Whether the queue is closed and empty."""
        with self._condition:
            return self._closed and not (self._messages or self._latched_messages)

    def close(self) -> None:
        """Close the queue: no more messages are added."""
        with self._condition:
            self._closed = True
            self._condition.notify_all()

    def _queue_with_oldest(self) -> deque[ReceivedMessage]:
        """Return the queue whose first message is older, or an empty queue if both are empty."""
        if not self._latched_messages or not self._messages:
            return self._latched_messages or self._messages
        return (
            self._latched_messages
            if self._latched_messages[0].received <= self._messages[0].received
            else self._messages
        )


def _size(message: ReceivedMessage) -> int:
    return len(message.data) + _OVERHEAD
