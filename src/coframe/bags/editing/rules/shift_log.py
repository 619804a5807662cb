# SPDX-License-Identifier: Apache-2.0
"""The rule ``shift-log`` shifts the receive times of a topic. The stamps in its messages are not changed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import did_you_mean
from coframe.bags._signed_duration import parse_offset
from coframe.bags.editing._rule import Rule, split_pair
from coframe.errors import EditError
from coframe.frame_names import absolute

if TYPE_CHECKING:
    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey

__all__ = ["ShiftLog"]

_MAX_TIME = (1 << 63) - 1


class ShiftLog(Rule):
    """``shift-log /points=-20ms``: the times of reception and publication; ``*`` is every topic."""

    name = "shift-log"
    form = "TOPIC=OFFSET"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        topic, offset = split_pair(text, self.form)
        self._topic = absolute(topic)
        self._offset = parse_offset(offset)
        if not self._offset:
            raise EditError(f"{text[:60]!r} shifts nothing: the offset is 0")

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that shifts the times of a message."""
        return self._shift if self._topic in {absolute(topic.name), "/*"} else None

    def _shift(self, message: EditedMessage) -> bool:
        message.received = min(max(message.received + self._offset, 0), _MAX_TIME)
        message.published = min(max(message.published + self._offset, 0), _MAX_TIME)
        self.changes += 1
        return True

    def nearest(self, survey: Survey) -> str:
        """Return a hint with similar topics."""
        return did_you_mean(self._topic, survey.input_topics)
