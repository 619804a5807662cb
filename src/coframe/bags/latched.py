"""What late joiners are given: the last messages of latched topics, which every file of a recording begins with."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe.bags.transforms import is_static
from coframe.errors import DecodeError
from coframe.messages import deserialize, find

if TYPE_CHECKING:
    from collections.abc import Hashable

__all__ = ["Latched", "LatchedMessage"]

_TF = "tf2_msgs/msg/TFMessage"
_MOST = 1000  # messages of one topic


class LatchedMessage(NamedTuple):
    """A message that still holds."""

    about: frozenset[Hashable]
    data: bytes
    published: int


class Latched:
    """The messages of one topic that still hold, in the order in which they came.

    Of static transforms each message holds until others have told of all its children; of other topics the last message
    of each publisher holds.
    """

    def __init__(self, topic: str, ros_type: str) -> None:
        self._is_static = is_static(topic) and ros_type == _TF
        self.messages: list[LatchedMessage] = []

    def add(self, data: bytes, published: int, publisher: Hashable) -> None:
        """Takes a message in; what it replaces goes."""
        about = self._about(data, publisher)
        self.messages = [message for message in self.messages if not message.about <= about][1 - _MOST :]
        self.messages.append(LatchedMessage(about, data, published))

    def _about(self, data: bytes, publisher: Hashable) -> frozenset[Hashable]:
        if not self._is_static:
            return frozenset([publisher])
        try:
            return frozenset(transform.child_frame_id for transform in deserialize(data, find(_TF)).transforms)
        except DecodeError:
            return frozenset()
