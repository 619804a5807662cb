# SPDX-License-Identifier: Apache-2.0
"""The rule ``rename-topic`` renames a topic."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import did_you_mean
from coframe.bags.editing._rule import Rule, split_pair
from coframe.errors import EditError
from coframe.frame_names import absolute

if TYPE_CHECKING:
    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey

__all__ = ["RenameTopic"]


class RenameTopic(Rule):
    """``rename-topic /old=/new``; ``/camera/*=/front/*`` renames all topics of a namespace."""

    name = "rename-topic"
    form = "OLD=NEW"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._old_name, self._new = map(absolute, split_pair(text, self.form))
        self._is_namespace = self._old_name.endswith("/*")
        if self._is_namespace != self._new.endswith("/*"):
            raise EditError(f"{text[:60]!r}: both names of a namespace end with /*, as in /camera/*=/front/*")

    def topic(self, name: str) -> str | None:
        """Return the new name of a topic."""
        if self._is_namespace:
            start = self._old_name[:-1]
            return self._new[:-1] + absolute(name)[len(start) :] if absolute(name).startswith(start) else name
        return self._new if absolute(name) == self._old_name else name

    def prepare(self, survey: Survey) -> None:
        """Refuse a name that another topic has.

        Raises:
            EditError: Two topics would have one name.
        """
        topics = survey.topics
        for old in topics:
            new = self.topic(old) or ""
            if new != old and new in topics and self.topic(new) == new and topics[new].type != topics[old].type:
                raise EditError(
                    f"{old} cannot be renamed to {new}: this topic exists and has the type {topics[new].type}, not "
                    f"{topics[old].type}",
                    hint="Choose another name, or remove the other topic first: `coframe bag edit --drop-topic`.",
                )

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that counts the messages on the topic."""
        if self.topic(topic.name) == topic.name:
            return None
        return self.count

    def count(self, _message: EditedMessage) -> bool:
        """Count a message."""
        self.changes += 1
        return True

    def nearest(self, survey: Survey) -> str:
        """Return a hint with similar topics."""
        return did_you_mean(self._old_name, survey.input_topics)
