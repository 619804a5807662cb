# SPDX-License-Identifier: Apache-2.0
"""Incoming messages on one topic with receive times, for all curves that use the topic."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from coframe._output.formatting import error_text
from coframe.errors import DecodeError, WireError
from coframe.messages import deserialize, find
from coframe.messages.header_peek import stamp_reader
from coframe.messages.slices import Slices
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from coframe.connection.connection import Connection
    from coframe.wire.batch_subscription import BatchSubscription, MessageBatch

__all__ = ["Arrivals", "ArrivedMessages"]

_ANY_PUBLISHER = QoS(depth=100, reliable=False)  # matches every publisher
_MAX_BYTES = 16 << 20  # of a message
_CAPACITY = 1000  # maximum number of messages between two polls
_PERIOD = 0.05  # seconds between two polls
_RETRY_PERIOD = 1.0  # seconds between searches for a publisher


class ArrivedMessages:
    """Messages on one topic that arrived since the last poll.

    Args:
        ros_type: The type of the messages, such as ``sensor_msgs/msg/Imu``.
        batch: Their bytes and times.

    Attributes:
        type: The type of the messages.
        slices: Their bytes.
        arrived: The receive times, (N,) nanoseconds.
        have_stamps: Whether messages of this type begin with a stamp.
        stamps: Their stamps, or the receive times where there is none, (N,) nanoseconds.
    """

    def __init__(self, ros_type: str, batch: MessageBatch) -> None:
        reader = stamp_reader(ros_type)
        self.type = ros_type
        self.slices = Slices.contiguous(batch.data, batch.ends)
        self.arrived: NDArray[np.int64] = batch.arrived
        self.have_stamps = reader is not None
        stamps = batch.arrived if reader is None else reader.stamps(self.slices, batch.arrived)
        self.stamps: NDArray[np.int64] = stamps.copy()
        self.stamps[stamps <= 0] = batch.arrived[stamps <= 0]
        self._decoded: list[Any] | None = None

    def decoded(self) -> list[Any]:
        """Return the messages; bytes if their type is unknown, or the error of a damaged message."""
        if self._decoded is None:
            self._decoded = [_decode(self.type, bytes(data)) for data in self.slices.each()]
        return self._decoded


class Arrivals:
    """Subscribes to a topic as long as any curve uses its messages.

    Args:
        connection: The connection to the graph.
        topic: The name of the topic.

    Attributes:
        problem: Why there is no subscription, or None if there is one.
    """

    def __init__(self, connection: Connection, topic: str) -> None:
        self.problem: str | None = f"no node publishes {topic}"
        self._connection = connection
        self._topic = topic
        self._receivers: list[Callable[[ArrivedMessages], None]] = []
        self._subscription: BatchSubscription | None = None
        self._type = ""
        self._due = 0.0

    def add(self, receiver: Callable[[ArrivedMessages], None]) -> None:
        """Call a function with the messages of each poll."""
        self._receivers.append(receiver)

    def remove(self, receiver: Callable[[ArrivedMessages], None]) -> None:
        """Stop calling a function; unsubscribe if it was the last one."""
        self._receivers.remove(receiver)
        if not self._receivers and self._subscription is not None:
            self._subscription.close()
            self._subscription = None

    def poll(self) -> None:
        """Pass on new messages, unless this was called very recently."""
        now = time.monotonic()
        if now < self._due:
            return
        self._due = now + _PERIOD
        if self._subscription is None:
            self._subscription = self._subscribe()
        if self._subscription is None:
            self._due = now + _RETRY_PERIOD
            return
        batch = self._subscription.take()
        if len(batch.ends):
            messages = ArrivedMessages(self._type, batch)
            for receiver in self._receivers:
                receiver(messages)

    def _subscribe(self) -> BatchSubscription | None:
        participant = self._connection.participant
        offered = participant.publishers(self._topic)
        if not offered:
            return None
        self._type = offered[0].ros_type
        self.problem = None
        try:
            return participant.batch_subscription(
                self._connection.node,
                self._topic,
                self._type,
                _ANY_PUBLISHER,
                max_bytes=_MAX_BYTES,
                capacity=_CAPACITY,
            )
        except WireError as error:
            self.problem = error_text(error)
            return None


def _decode(ros_type: str, data: bytes) -> Any:
    try:
        return deserialize(data, find(ros_type))
    except LookupError:
        return data
    except DecodeError as error:
        return error
