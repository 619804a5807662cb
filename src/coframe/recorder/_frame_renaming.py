# SPDX-License-Identifier: Apache-2.0
"""Rename the frames in the messages of one robot before they are recorded."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.bags.message_frames import FrameNames
from coframe.frame_names import is_robot_topic
from coframe.messages.schema_classes import known_class

if TYPE_CHECKING:
    from coframe import _core
    from coframe.recorder._message_queue import MessageSource

__all__ = ["FrameRenamer"]


class FrameRenamer:
    """Renames the frames in messages on the topics of one robot.

    Args:
        names: The renaming.
        tf_topic: The topic of the robot's transforms. All topics in its namespace belong to the robot.
        tf_static_topic: The topic of the robot's static transforms.

    Attributes:
        not_renamed: The topics whose frames cannot be renamed because the definition of their type is unknown. A
            dict is used as an ordered set.
    """

    def __init__(self, names: _core.Renaming, tf_topic: str, tf_static_topic: str) -> None:
        self.not_renamed: dict[str, None] = {}
        self._names = names
        self._topics = (tf_topic, tf_static_topic)
        self._plans: dict[MessageSource, FrameNames | None] = {}

    def rename_message(self, source: MessageSource, data: bytes) -> bytes:
        """Return the message with renamed frames; unchanged if it has no frames or is damaged."""
        if source not in self._plans:
            self._plans[source] = self._plan(source)
        frames = self._plans[source]
        if frames is None:
            return data
        try:
            return frames.rename(data, self._names)[0]
        except Exception:  # noqa: BLE001 - decoding damaged bytes can raise many exceptions
            return data

    def _plan(self, source: MessageSource) -> FrameNames | None:
        if not is_robot_topic(source.topic, *self._topics):
            return None
        cls = known_class(source.type)
        if cls is None:
            self.not_renamed[source.topic] = None
            return None
        frames = FrameNames(cls)
        return frames if frames.exist else None
