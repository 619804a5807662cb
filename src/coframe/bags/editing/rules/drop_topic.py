# SPDX-License-Identifier: Apache-2.0
"""The rule ``drop-topic``: a topic is left out."""

from __future__ import annotations

import fnmatch
import re
from typing import TYPE_CHECKING

from coframe._output.formatting import did_you_mean
from coframe.bags.editing._rule import Rule
from coframe.errors import EditError
from coframe.frame_names import absolute

if TYPE_CHECKING:
    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey

__all__ = ["DropTopic"]


class DropTopic(Rule):
    """``drop-topic /camera/image``; ``*`` stands for any characters."""

    name = "drop-topic"
    form = "TOPIC"
    verb = "removed"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        if not text.strip("/ "):
            raise EditError(f"{text[:60]!r} is not the name of a topic")
        self._pattern = absolute(text.strip())
        self._match = re.compile(fnmatch.translate(self._pattern)).match

    def topic(self, name: str) -> str | None:
        """Return None for a topic that is dropped."""
        return None if self._match(absolute(name)) else name

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that drops the messages of the topic."""
        return self.drop if self.topic(topic.name) is None else None

    def drop(self, _message: EditedMessage) -> bool:
        """Count a message that is dropped."""
        self.changes += 1
        return False

    def nearest(self, survey: Survey) -> str:
        """Return a hint with similar topics."""
        return did_you_mean(self._pattern, survey.input_topics)
