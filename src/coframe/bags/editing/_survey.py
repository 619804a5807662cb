# SPDX-License-Identifier: Apache-2.0
"""A survey of a recording for the rules: its topics, times and static transforms."""

from __future__ import annotations

from contextlib import suppress
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from coframe.bags.editing._message import EditedMessage, EditedTopic
from coframe.errors import DecodeError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags.editing._rule import Rule
    from coframe.bags.editing._transform_bytes import RecordedTransform
    from coframe.bags.storage import Channel

__all__ = ["FoundTransform", "Source", "Survey"]

_MAX_STATIC = 10_000  # static transforms that are compared
_MAX_SAMPLED_MESSAGES = 200  # messages on a topic whose frame names are collected for hints
_MAX_SAMPLED = 20_000  # messages on all topics together


class Source:
    """What a survey reads from: the files of a recording."""

    def channels(self) -> list[Channel]:
        """Return all channels."""
        raise NotImplementedError

    def span(self) -> tuple[int, int] | None:
        """Return the first and last receive time in nanoseconds, or None if there are no messages."""
        raise NotImplementedError

    def messages(self, is_selected: Callable[[Channel], bool]) -> Iterator[tuple[Channel, int, bytes]]:
        """Yield the messages of some channels in file order: channel, receive time, bytes."""
        raise NotImplementedError


class FoundTransform(NamedTuple):
    """A static transform of the input.

    Attributes:
        topic: Name of the topic, after the rules before.
        parent: The parent frame, after the rules before.
        child: The child frame, after the rules before.
        received: The first receive time in nanoseconds.
        transform: The transform as recorded.
        header: The encapsulation header of its message.
    """

    topic: str
    parent: str
    child: str
    received: int
    transform: RecordedTransform
    header: bytes


class Survey:
    """Facts about a recording, read when they are first needed, with the names after the rules before.

    Args:
        source: The files.
        types: The types of the recording.
    """

    def __init__(self, source: Source, types: RecordedTypes) -> None:
        self._source = source
        self._types = types
        self._rules: list[Rule] = []

    def add(self, rule: Rule) -> None:
        """Let later rules find the names that this rule writes."""
        self._rules.append(rule)

    @cached_property
    def span(self) -> tuple[int, int]:
        """The first and last receive time in nanoseconds; 0 and 0 if there are no messages."""
        return self._source.span() or (0, 0)

    @property
    def topics(self) -> dict[str, Channel]:
        """A channel of each topic, by the name after the rules before."""
        return {name: channel for channel in self._source.channels() if (name := self._topic(channel.topic))}

    @property
    def input_topics(self) -> list[str]:
        """The names of the topics in the input."""
        return sorted({channel.topic for channel in self._source.channels()})

    @property
    def publishers(self) -> list[str]:
        """The nodes whose names the recording contains."""
        return sorted({channel.publisher for channel in self._source.channels() if channel.publisher})

    def static_transforms(self) -> list[FoundTransform]:
        """Return the first of each static transform."""
        found: dict[tuple[str, str], FoundTransform] = {}
        for topic, parent, child, received, transform, header in self._static_transforms:
            name = self._topic(topic)
            if name is not None:
                one = FoundTransform(name, self._frame(parent), self._frame(child), received, transform, header)
                found.setdefault((one.topic, one.child), one)
        return list(found.values())

    @cached_property
    def _static_transforms(self) -> list[FoundTransform]:
        found: dict[tuple[str, bytes], FoundTransform] = {}
        for topic, received, message in self._messages(lambda topic: topic.is_static and topic.has_transforms):
            with suppress(DecodeError):
                for transform in message.transforms():
                    if len(found) < _MAX_STATIC:
                        names = [
                            str(name, "utf-8", "replace").lstrip("/") for name in (transform.parent, transform.child)
                        ]
                        header = message.data[:4]
                        new = FoundTransform(topic.name, names[0], names[1], received, transform, header)
                        found.setdefault((topic.name, transform.child), new)
        return list(found.values())

    def messages(self, is_selected: Callable[[EditedTopic], bool]) -> Iterator[tuple[EditedTopic, int, EditedMessage]]:
        """Yield the messages on some topics, as recorded, with the names of their topics after the rules before."""
        for topic, received, message in self._messages(lambda topic: is_selected(self._rename_topic(topic))):
            yield self._rename_topic(topic), received, message

    @cached_property
    def frames(self) -> set[str]:
        """The frame names in the first messages of each topic, as recorded: for hints."""
        found: set[str] = set()
        counts: dict[Channel, int] = {}
        left = _MAX_SAMPLED
        for topic, _, message in self._messages(lambda topic: topic.has_transforms or topic.frames is not None):
            counts[topic.channel] = counts.get(topic.channel, 0) + 1
            left -= 1
            if counts[topic.channel] <= _MAX_SAMPLED_MESSAGES and topic.frames is not None:
                with suppress(DecodeError, ValueError):
                    found |= topic.frames.names(message.data)
            if not left:
                break
        return found - {""}

    def _messages(self, is_selected: Callable[[EditedTopic], bool]) -> Iterator[tuple[EditedTopic, int, EditedMessage]]:
        topics = {channel: EditedTopic(channel, channel.topic, self._types) for channel in self._source.channels()}
        channels = {channel for channel, topic in topics.items() if is_selected(topic)}
        if channels:
            for channel, received, data in self._source.messages(channels.__contains__):
                yield topics[channel], received, EditedMessage(data, received, received)

    def _rename_topic(self, topic: EditedTopic) -> EditedTopic:
        return EditedTopic(topic.channel, self._topic(topic.name) or "", self._types)

    def _topic(self, name: str) -> str | None:
        new: str | None = name
        for rule in self._rules:
            new = None if new is None else rule.topic(new)
        return new

    def _frame(self, name: str) -> str:
        for rule in self._rules:
            name = rule.frame(name)
        return name
