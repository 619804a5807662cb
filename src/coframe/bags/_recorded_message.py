# SPDX-License-Identifier: Apache-2.0
"""Topics and messages of a recording, as values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from coframe._output import html_tables
from coframe._output.formatting import count
from coframe.errors import DecodeError

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["RecordedMessage", "RecordedTopic", "RecordedTopics"]


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

    def _repr_html_(self) -> str:
        return html_tables.record(self.name, self._asdict().items())


class RecordedTopics(dict[str, RecordedTopic]):
    """The topics of a recording by name; a dictionary that notebooks show as a table."""

    def _repr_html_(self) -> str:
        return html_tables.section(count(len(self), "topic"), self.html_table())

    def html_table(self) -> str:
        """Return the topics as an HTML table."""
        rows = ((topic.name, topic.type, topic.messages, f"{topic.rate:.3g} Hz") for topic in self.values())
        return html_tables.table(("topic", "type", "messages", "rate"), rows, len(self), "topic")


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

    def _repr_html_(self) -> str:
        fields = {"topic": self.topic, "type": self.type, "stamp": self.stamp, "received": self.received}
        try:
            message = self.message
        except DecodeError as error:
            return html_tables.record(repr(self), {**fields, "problem": error}.items())
        show = getattr(message, "_repr_html_", None)
        return html_tables.record(repr(self), fields.items()) + (show() if show else "")
