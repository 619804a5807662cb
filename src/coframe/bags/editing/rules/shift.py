# SPDX-License-Identifier: Apache-2.0
"""The rule ``shift``: the stamps of a topic, a frame or a node are moved by a duration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import count, did_you_mean
from coframe.bags._message_fields import MAX_STAMP
from coframe.bags._signed_duration import parse_offset
from coframe.bags.editing._rule import Rule, split_pair
from coframe.errors import EditError
from coframe.frame_names import absolute

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey

__all__ = ["Shift"]


class Shift(Rule):
    """``shift /points=+35ms``: the stamps in all messages of a topic, of a frame or of a node.

    A name that is a topic is a topic; the name of a node that the recording contains is a node; any other name is a
    frame. Of a frame, the transforms whose child frame it is and the messages whose header names it are shifted; of
    ``PARENT->CHILD``, only these transforms. Stamps of 0 stay, because they mean that no stamp was set.
    """

    name = "shift"
    form = "TOPIC|FRAME|NODE=OFFSET"
    unit = "stamp"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._subject, offset = split_pair(text, self.form)
        self._offset = parse_offset(offset)
        if not self._offset:
            raise EditError(f"{text[:60]!r} shifts nothing: the offset is 0")
        parent, self._is_edge, child = (part.strip() for part in self._subject.partition("->"))
        self._parent, self._child = (name.removeprefix("/").encode() for name in (parent, child or parent))
        self._is_topic = self._is_node = False
        self._refused_count = 0

    def prepare(self, survey: Survey) -> None:
        """Find out whether the name is that of a topic, a node or a frame."""
        self._is_topic = absolute(self._subject) in map(absolute, survey.topics)
        self._is_node = not self._is_topic and absolute(self._subject) in map(absolute, survey.publishers)

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that shifts the stamps in a message."""
        if self._is_topic or self._is_node:
            name = topic.name if self._is_topic else topic.channel.publisher
            return self._shift_all(topic) if name and absolute(name) == absolute(self._subject) else None
        if topic.has_transforms:
            return self._shift_child
        return None if self._is_edge else self._shift_messages_of_frame(topic)

    def _new_stamp(self, stamp: int) -> int:
        if 0 <= stamp + self._offset < MAX_STAMP:
            return stamp + self._offset
        self._refused_count += 1
        return stamp

    def _shift_all(self, topic: EditedTopic) -> Step | None:
        stamps = topic.stamps
        if stamps is None:
            return None

        def step(message: EditedMessage) -> bool:
            new, change_count = stamps.change(message.data, self._new_stamp)
            if change_count:
                message.data = new
                self.changes += change_count
            return True

        return step

    def _shift_child(self, message: EditedMessage) -> bool:
        if self._child not in message.data:
            return True
        transforms, change_count = message.transforms(), 0
        for transform in transforms:
            if transform.child.removeprefix(b"/") != self._child or not transform.stamp:
                continue
            if self._is_edge and transform.parent.removeprefix(b"/") != self._parent:
                continue
            new = self._new_stamp(transform.stamp)
            change_count += new != transform.stamp
            transform.stamp = new
        if change_count:
            message.set_transforms(transforms)
            self.changes += change_count
        return True

    def _shift_messages_of_frame(self, topic: EditedTopic) -> Step | None:
        stamps, frames = topic.stamps, topic.frames
        if stamps is None or frames is None:
            return None
        child_frame = self._child.decode()

        def step(message: EditedMessage) -> bool:
            data = message.data
            if self._child in data and frames.of_header(data).removeprefix("/") == child_frame:
                message.data, change_count = stamps.change(data, self._new_stamp)
                self.changes += change_count
            return True

        return step

    def remarks(self) -> Iterator[str]:
        """Yield how many stamps cannot be shifted."""
        if self._refused_count:
            yield f"{self}: {count(self._refused_count, 'stamp')} would be before 1970 or after 2038: not changed"

    def nearest(self, survey: Survey) -> str:
        """Return a hint with similar topics and frames."""
        return did_you_mean(self._subject, [*survey.input_topics, *survey.frames, *survey.publishers])
