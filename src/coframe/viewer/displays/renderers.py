# SPDX-License-Identifier: Apache-2.0
"""Renderers: convert the messages of a topic to drawings, one after another, outside the server's thread."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Protocol, TypeAlias

from coframe.viewer.displays import DRAW_FUNCTIONS, CannotDrawError, Drawing, Options
from coframe.viewer.displays.drawing import pose_row
from coframe.viewer.displays.markers import MarkerSet
from coframe.viewer.displays.shapes import Row, draw_odometry

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["MeshUrl", "Renderer", "make_renderer"]

MeshUrl: TypeAlias = "Callable[[str], tuple[str | None, str | None]]"
# How many earlier messages determine the markers after a jump in time.
_MARKER_MESSAGES = 500


class Renderer(Protocol):
    """Converts messages of one topic to drawings."""

    def draw(self, message: StampedMessage, time: int) -> list[Drawing]:
        """Return what is visible at a time in nanoseconds, if `message` is the last message.

        Raises:
            ValueError: The message cannot be drawn.
        """

    def has_expired(self, time: int) -> bool:
        """Return whether a part of the last drawing is no longer visible at a time in nanoseconds."""


class MessageRenderer:
    """Draws each message independently of the others."""

    def __init__(self, messages: TopicMessages, options: Options) -> None:
        self._type = messages.type
        self._options = options

    def draw(self, message: StampedMessage, time: int) -> list[Drawing]:
        """Return the drawing of the message."""
        del time
        draw = DRAW_FUNCTIONS.get(self._type)
        if draw is None:
            raise CannotDrawError(f"the viewer has no display for {self._type}")
        return [draw(message.read(), self._options)]

    def has_expired(self, time: int) -> bool:
        """Return False."""
        del time
        return False


class OdometryRenderer:
    """Draws the last poses as a trail."""

    def __init__(self, messages: TopicMessages, options: Options) -> None:
        self._new_messages = _NewMessages(messages, options.keep)
        self._options = options
        self._trail: deque[Row] = deque(maxlen=options.keep)

    def draw(self, message: StampedMessage, time: int) -> list[Drawing]:
        """Return the drawing of the message and of the trail that ends there."""
        del time
        continues, new = self._new_messages.until(message)
        if not continues:
            self._trail.clear()
        for one in new:
            self._trail.append(pose_row(one.read().pose.pose))
        return [draw_odometry(message.read(), list(self._trail), self._options)]

    def has_expired(self, time: int) -> bool:
        """Return False."""
        del time
        return False


class MarkerRenderer:
    """Maintains the set of markers that the messages define."""

    def __init__(self, messages: TopicMessages, options: Options, mesh_url: MeshUrl) -> None:
        self._new_messages = _NewMessages(messages, _MARKER_MESSAGES)
        self._options = options
        self._set = MarkerSet(mesh_url)

    def draw(self, message: StampedMessage, time: int) -> list[Drawing]:
        """Return one drawing per group of visible markers."""
        continues, new = self._new_messages.until(message)
        if not continues:
            self._set.clear()
        for one in new:
            self._set.apply(one.read(), one.time)
        self._set.expire(time)
        return self._set.draw(self._options)

    def has_expired(self, time: int) -> bool:
        """Return whether the lifetime of a marker is over."""
        return self._set.has_expired(time)


def make_renderer(messages: TopicMessages, options: Options, mesh_url: MeshUrl) -> Renderer:
    """Return a renderer for the messages of a topic."""
    if messages.type == "nav_msgs/msg/Odometry":
        return OdometryRenderer(messages, options)
    if messages.type.startswith("visualization_msgs/msg/Marker"):
        return MarkerRenderer(messages, options, mesh_url)
    return MessageRenderer(messages, options)


class _NewMessages:
    """The messages between two requests."""

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
