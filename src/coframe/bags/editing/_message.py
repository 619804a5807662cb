# SPDX-License-Identifier: Apache-2.0
"""A message that is copied from one recording to another, and its topic."""

from __future__ import annotations

import struct
from functools import cached_property
from typing import TYPE_CHECKING

from coframe.bags._message_fields import FrameFields, StampFields
from coframe.bags.editing._transform_bytes import RecordedTransform, join_transforms, split_transforms
from coframe.bags.transforms import is_static
from coframe.messages.encapsulation import BYTE_ORDERS
from coframe.type_names import is_tf_message

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags.storage import Channel

__all__ = ["EditedMessage", "EditedTopic"]


class EditedMessage:
    """A message that rules change in place.

    Attributes:
        received: Receive time in nanoseconds.
        published: Time of publication in nanoseconds.
    """

    __slots__ = ("_data", "_is_joined", "_transforms", "published", "received")

    def __init__(self, data: bytes, received: int, published: int) -> None:
        self._data = data
        self._transforms: list[RecordedTransform] | None = None
        self._is_joined = True
        self.received = received
        self.published = published

    @property
    def data(self) -> bytes:
        """The serialized message."""
        if not self._is_joined and self._transforms is not None:
            self._data, self._is_joined = join_transforms(self._transforms, self._data[:4]), True
        return self._data

    @data.setter
    def data(self, data: bytes) -> None:
        self._data, self._transforms, self._is_joined = data, None, True

    def transforms(self) -> list[RecordedTransform]:
        """Return the transforms of a TFMessage; call :meth:`set_transforms` after changing them.

        Raises:
            DecodeError: The bytes are damaged.
        """
        if self._transforms is None:
            self._transforms = split_transforms(self._data)
        return self._transforms

    def set_transforms(self, transforms: Sequence[RecordedTransform]) -> None:
        """Replace the transforms of a TFMessage."""
        self._transforms, self._is_joined = list(transforms), False

    def pack_pose(self, pose: tuple[float, ...]) -> bytes:
        """Return x, y, z, qx, qy, qz, qw as bytes in the byte order of a TFMessage."""
        return struct.pack(f"{BYTE_ORDERS[self._data[:2]]}7d", *pose)


class EditedTopic:
    """The messages of one channel after all earlier rules were applied.

    Attributes:
        channel: The channel of the input.
        name: The name of the topic after the rules before.
        types: The types of the recording.
    """

    def __init__(self, channel: Channel, name: str, types: RecordedTypes) -> None:
        self.channel = channel
        self.name = name
        self.types = types

    @property
    def is_static(self) -> bool:
        """Whether the messages are static transforms, by the name of the topic."""
        return is_static(self.name)

    @property
    def has_transforms(self) -> bool:
        """Whether the messages are TFMessages, which rules edit transform by transform."""
        return self.channel.encoding == "cdr" and is_tf_message(self.channel.type)

    @cached_property
    def frames(self) -> FrameFields | None:
        """The frame names in the messages, or None if they have none or are in an unknown type or encoding."""
        return FrameFields.of(self.channel, self.types)

    @cached_property
    def stamps(self) -> StampFields | None:
        """The stamps in the messages, or None if they have none or are in an unknown type or encoding."""
        return StampFields.of(self.channel, self.types)
