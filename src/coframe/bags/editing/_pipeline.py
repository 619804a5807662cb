# SPDX-License-Identifier: Apache-2.0
"""The rules that apply to the messages of a channel, combined into one function."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe.bags.editing._message import EditedMessage, EditedTopic
from coframe.bags.storage import Channel
from coframe.errors import CoframeError
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.bags._problems import Problems
    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags.editing._rule import Rule, Step
    from coframe.bags.editing._survey import Survey

__all__ = ["InsertedMessage", "Pipeline", "Route"]


class InsertedMessage(NamedTuple):
    """A message to add at the beginning: the name of its topic, its bytes and its receive time in nanoseconds."""

    topic: str
    data: bytes
    received: int


class Route:
    """The edits to the messages of one channel.

    Attributes:
        topic: The new name of the topic, or None if it is dropped.
        steps: The functions that edit each message.
    """

    def __init__(
        self, topic: str | None, steps: list[Step], counting: list[Rule], problem: str, problems: Problems
    ) -> None:
        self.topic = topic
        self.steps = steps
        self._counting_rules = counting
        self._problem = problem
        self._problems = problems

    def count(self, messages: int) -> None:
        """Count messages of the channel for the rules that rename or drop its topic."""
        for rule in self._counting_rules:
            rule.changes += messages

    def edit(self, message: EditedMessage) -> bool:
        """Edit a message in place, and return False if it is dropped. A damaged message is not changed."""
        before = message.data
        try:
            return all(step(message) for step in self.steps)
        except (CoframeError, ValueError, TypeError, LookupError, OverflowError, AttributeError, RecursionError):
            message.data = before
            self._problems.add(self._problem)
            return True


class Pipeline:
    """The rules of an edit, prepared for one recording.

    Args:
        rules: The rules in the order in which they are applied.
        survey: The recording.
        types: The types of the recording.
        problems: Receives what could not be edited.

    Raises:
        EditError: A rule cannot be applied to the recording.
    """

    def __init__(self, rules: Sequence[Rule], survey: Survey, types: RecordedTypes, problems: Problems) -> None:
        self._rules = rules
        self._types = types
        self._problems = problems
        self._routes: dict[Channel, Route] = {}
        self.inserted: list[InsertedMessage] = []
        for rule in rules:
            rule.prepare(survey)
            survey.add(rule)
        start = survey.span[0]
        for number, rule in enumerate(rules):
            start = rule.start(start)
            for topic, data in rule.insertions():
                self._insert(topic, data, number)
        self.inserted = [message._replace(received=start) for message in self.inserted]

    def route(self, channel: Channel) -> Route:
        """Return the route of the messages of a channel."""
        if channel not in self._routes:
            self._routes[channel] = self._new_route(channel, channel.topic, 0)
        return self._routes[channel]

    def unchanged(self, topic: str) -> Route:
        """Return the route of messages that are not edited."""
        return Route(topic, [], [], "", self._problems)

    def topic(self, name: str) -> str | None:
        """Return the new name of a topic, or None if it is dropped."""
        new: str | None = name
        for rule in self._rules:
            new = None if new is None else rule.topic(new)
        return new

    def _new_route(self, channel: Channel, name: str, first: int) -> Route:
        steps, counting = [], []
        new: str | None = name
        for rule in self._rules[first:]:
            if new is None:
                break
            renamed = rule.topic(new)
            if renamed != new:
                counting.append(rule)
            elif (step := rule.step(EditedTopic(channel, new, self._types))) is not None:
                steps.append(step)
            new = renamed
        problem = f"{channel.topic}: messages that cannot be decoded were copied unchanged"
        return Route(new, steps, counting, problem, self._problems)

    def _insert(self, topic: str, data: bytes, number: int) -> None:
        """Apply the later rules to a message that a rule inserts."""
        route = self._new_route(Channel(topic, TF_MESSAGE, "cdr"), topic, number + 1)
        message = EditedMessage(data, 0, 0)
        if route.topic is not None and route.edit(message):
            self.inserted.append(InsertedMessage(route.topic, message.data, 0))
