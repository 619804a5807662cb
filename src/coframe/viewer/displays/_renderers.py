# SPDX-License-Identifier: Apache-2.0
"""Renderers: convert the messages on a topic to drawings, one after another, outside the server's thread."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from coframe.errors import CoframeError

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.viewer.displays._drawing import Drawing, Options
    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = [
    "NewMessages",
    "Renderer",
    "RendererFactory",
    "UnfinishedError",
    "draw_each_message",
]

RendererFactory: TypeAlias = "Callable[[TopicMessages, Options, Resources], Renderer]"
"""Returns a renderer for the messages on a topic."""


class UnfinishedError(CoframeError, RuntimeError):
    """Drawing takes longer; the next call continues. The message describes the progress."""


class Renderer(Protocol):
    """Converts messages on one topic to drawings."""

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return what is visible if `message` is the last message.

        Args:
            message: The message.
            time: The displayed time in nanoseconds, at which lifetimes end.
            at: The time of the newest messages on other topics; 0 if there is no limit.

        Raises:
            ValueError: The message cannot be drawn.
            UnfinishedError: The drawing is not complete yet.
        """

    def has_changed(self, time: int, at: int) -> bool:
        """Return whether the last drawing is out of date, although the message is the same.

        Args:
            time: The time of the message, as in `draw`.
            at: The displayed time, as in `draw`.
        """


class _EachMessage:
    """Draws each message independently of the others."""

    def __init__(self, draw: Callable[[Any, Options], Drawing], options: Options) -> None:
        self._draw = draw
        self._options = options

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return the drawing of the message."""
        del time, at
        return [self._draw(message.read(), self._options)]

    def has_changed(self, time: int, at: int) -> bool:
        """Return False."""
        del time, at
        return False


def draw_each_message(draw: Callable[[Any, Options], Drawing]) -> RendererFactory:
    """Return a factory of renderers that draw each message by itself, with a function."""
    return lambda _messages, options, _resources: _EachMessage(draw, options)


class NewMessages:
    """The messages on a topic between two requests, for renderers that need all of them.

    Args:
        messages: The messages on the topic.
        limit: How many earlier messages are returned after a jump in time.
    """

    def __init__(self, messages: TopicMessages, limit: int) -> None:
        self._messages = messages
        self._limit = limit
        self._last: int | None = None

    def until(self, message: StampedMessage) -> tuple[bool, list[StampedMessage]]:
        """Return whether the messages continue those of the previous call, and the messages up to `message`."""
        last, self._last = self._last, message.key
        known = [one for one in self._messages.before(message.time, self._limit) if one.key <= message.key]
        known = known or [message]
        if last is not None and known[0].key <= last + 1 and last <= message.key:
            return True, [one for one in known if one.key > last]
        return False, known
