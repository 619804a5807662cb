# SPDX-License-Identifier: Apache-2.0
"""Latched (transient-local) messages: late joiners receive them, and each file of a recording begins with them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe.bags.transforms import is_static
from coframe.errors import DecodeError
from coframe.messages import deserialize, find

if TYPE_CHECKING:
    from collections.abc import Hashable

__all__ = ["LatchedMessage", "LatchedMessages"]

_TF = "tf2_msgs/msg/TFMessage"
_MAX_MESSAGES = 1000  # of one topic


class LatchedMessage(NamedTuple):
    """A message that is still valid.

    Attributes:
        keys: What the message describes: its child frames, or its publisher.
        data: The serialized message.
        published: When it was published, in nanoseconds.
    """

    keys: frozenset[Hashable]
    data: bytes
    published: int


class LatchedMessages:
    """The valid messages of one topic, in the order in which they were received.

    A message of static transforms is valid until later messages have replaced all its child frames. On other topics,
    the last message of each publisher is valid.
    """

    def __init__(self, topic: str, ros_type: str) -> None:
        self._is_static = is_static(topic) and ros_type == _TF
        self.messages: list[LatchedMessage] = []

    def add(self, data: bytes, published: int, publisher: Hashable) -> None:
        """Add a message, and remove those that it replaces."""
        keys = self._keys(data, publisher)
        self.messages = [message for message in self.messages if not message.keys <= keys][1 - _MAX_MESSAGES :]
        self.messages.append(LatchedMessage(keys, data, published))

    def _keys(self, data: bytes, publisher: Hashable) -> frozenset[Hashable]:
        if not self._is_static:
            return frozenset([publisher])
        try:
            return frozenset(transform.child_frame_id for transform in deserialize(data, find(_TF)).transforms)
        except DecodeError:
            return frozenset()
