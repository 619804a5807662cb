# SPDX-License-Identifier: Apache-2.0
"""Topics and messages of a recording, as values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["RecordedMessage", "RecordedTopic"]


class RecordedTopic(NamedTuple):
    """A topic of a recording.

    Attributes:
        name: Name of the topic.
        type: Type of its messages, such as ``sensor_msgs/msg/Imu``; as recorded if it is not a ROS type.
        messages: Number of messages.
        rate: Messages per second, or 0 for fewer than two messages or a single burst.
        encoding: Encoding of the messages: ``cdr``, ``ros1``, ``protobuf``, ``json``, ...
    """

    name: str
    type: str
    messages: int
    rate: float
    encoding: str


class RecordedMessage:
    """A message of a recording. All times are in nanoseconds.

    Attributes:
        topic: Name of its topic.
        type: Name of its type.
        stamp: The stamp of its header; the receive time if it has none.
        received: The receive time.
        data: The serialized message.
    """

    __slots__ = ("_decode", "_message", "data", "received", "stamp", "topic", "type")

    def __init__(
        self, topic: str, type_: str, stamp: int, received: int, data: bytes, decode: Callable[[bytes], Any]
    ) -> None:
        self.topic = topic
        self.type = type_
        self.stamp = stamp
        self.received = received
        self.data = data
        self._decode = decode

    @property
    def message(self) -> Any:
        """The message, decoded on first access; bytes if its type is unknown.

        Raises:
            DecodeError: The bytes are damaged.
        """
        if not hasattr(self, "_message"):
            self._message = self._decode(self.data)
        return self._message

    def __repr__(self) -> str:
        return f"RecordedMessage({self.topic!r}, {self.type}, stamp={self.stamp}, {len(self.data)} bytes)"
