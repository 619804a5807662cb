"""The frames in messages of one robot, under other names: what a recorder makes of them before they are written."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.bags.message_frames import FrameNames
from coframe.bags.storage import Channel
from coframe.frame_names import belongs

if TYPE_CHECKING:
    from coframe import _core
    from coframe.recorder.message_queue import Source

__all__ = ["FrameRenamer"]


class FrameRenamer:
    """Renames the frames in the messages of a robot's topics.

    Args:
        names: What they are called.
        tf_topic: Where the robot's transforms are sent; the other topics of its namespace are the robot's, too.
        tf_static_topic: Where its static transforms are sent.

    Attributes:
        not_renamed: Topics whose frames keep their names, as nobody says what their messages are made of; keys, since
            they are in order and there once.
    """

    def __init__(self, names: _core.Renaming, tf_topic: str, tf_static_topic: str) -> None:
        self.not_renamed: dict[str, None] = {}
        self._names = names
        self._topics = (tf_topic, tf_static_topic)
        self._plans: dict[Source, FrameNames | None] = {}

    def renamed(self, source: Source, data: bytes) -> bytes:
        """The message with its new names; as it is where it has none, or is damaged."""
        if source not in self._plans:
            self._plans[source] = self._plan(source)
        frames = self._plans[source]
        if frames is None:
            return data
        try:
            return frames.renamed(data, self._names)[0]
        except Exception:  # noqa: BLE001 - the library has many ways to say that bytes are damaged
            return data

    def _plan(self, source: Source) -> FrameNames | None:
        if not belongs(source.topic, *self._topics):
            return None
        frames = FrameNames.of(Channel(source.topic, source.type, "cdr"), source.type)
        if frames is None:
            self.not_renamed[source.topic] = None
        return frames if frames and frames.are_there else None
