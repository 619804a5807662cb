# SPDX-License-Identifier: Apache-2.0
"""Latched (transient-local) messages: late joiners receive them, and each file of a recording begins with them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe.bags.transforms import is_static
from coframe.errors import DecodeError
from coframe.messages import deserialize, find
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable

__all__ = ["LatchedMessage", "LatchedMessages", "LatchedSpace"]

MAX_MESSAGES = 10_000
MAX_BYTES = 64 << 20


class LatchedSpace:
    """Limits the number and size of all latched messages of a recording, so that they do not fill the memory."""

    def __init__(self) -> None:
        self._messages = 0
        self._bytes = 0

    def take(self, size: int) -> bool:
        """Reserve space for a message of `size` bytes. Return False if there is not enough."""
        if self._messages >= MAX_MESSAGES or self._bytes + size > MAX_BYTES:
            return False
        self._messages += 1
        self._bytes += size
        return True

    def give_back(self, size: int) -> None:
        """Release the space of a message."""
        self._messages -= 1
        self._bytes -= size


class LatchedMessage(NamedTuple):
    """A message that is still valid.

    Attributes:
        data: The serialized message.
        published: The publication time in nanoseconds.
    """

    data: bytes
    published: int


class LatchedMessages:
    """The valid messages on one topic, in the order in which they were received.

    A message of static transforms is valid until later messages have replaced all its child frames. On other topics,
    the last message of each publisher is valid.

    Args:
        topic: The name of the topic.
        ros_type: The type of its messages.
        space: The space for the messages on all topics.

    Attributes:
        omitted: Number of messages for which there was no space.
    """

    def __init__(self, topic: str, ros_type: str, space: LatchedSpace) -> None:
        self._is_static = is_static(topic) and ros_type == TF_MESSAGE
        self._space = space
        self._messages: dict[int, LatchedMessage] = {}
        self._last: dict[Hashable, int] = {}  # the number of the last message that describes a frame or a publisher
        self._described_channels: dict[int, int] = {}  # how many of these a message is the last one of
        self._count = 0
        self.omitted = 0

    @property
    def messages(self) -> Iterable[LatchedMessage]:
        """The valid messages."""
        return self._messages.values()

    def add(self, data: bytes, published: int, publisher: Hashable) -> None:
        """Add a message, and remove those that it replaces."""
        keys = self._keys(data, publisher)
        for key in keys:
            self._forget(key)
        if not self._space.take(len(data)):
            self.omitted += 1
            return
        self._count += 1
        self._messages[self._count] = LatchedMessage(data, published)
        self._described_channels[self._count] = len(keys)
        self._last.update(dict.fromkeys(keys, self._count))

    def _forget(self, key: Hashable) -> None:
        number = self._last.pop(key, None)
        if number is None:
            return
        self._described_channels[number] -= 1
        if not self._described_channels[number]:
            del self._described_channels[number]
            self._space.give_back(len(self._messages.pop(number).data))

    def _keys(self, data: bytes, publisher: Hashable) -> frozenset[Hashable]:
        """Return the keys that a message replaces: its child frames, or its publisher."""
        if self._is_static:
            try:
                frames = frozenset(
                    transform.child_frame_id for transform in deserialize(data, find(TF_MESSAGE)).transforms
                )
            except DecodeError:
                frames = frozenset()
            if frames:
                return frames
        return frozenset([(publisher,)])  # a tuple, which never equals a frame name
