"""Who makes the drawings of a topic's messages: one after the other, in a thread that is not the server's."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Protocol, TypeAlias

from coframe.viewer.displays import DRAWN_BY, CannotDrawError, Drawing, Options
from coframe.viewer.displays.drawing import pose_row
from coframe.viewer.displays.markers import MarkerSet
from coframe.viewer.displays.shapes import Row, draw_odometry

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.viewer.sources.messages import Messages, Sighting

__all__ = ["Artist", "MeshUrl", "artist_for"]

MeshUrl: TypeAlias = "Callable[[str], tuple[str | None, str | None]]"
# How many messages a set of markers is put together from, where it was not followed from the start.
_MARKER_MESSAGES = 500


class Artist(Protocol):
    """Makes drawings."""

    def draw(self, sighting: Sighting, time: int) -> list[Drawing]:
        """What is to be seen at a time in nanoseconds, when a message is the last one.

        Raises:
            ValueError: Nothing can be drawn of it.
        """

    def fades(self, time: int) -> bool:
        """Whether at a time something of the last drawing is to be seen no more."""


class PlainArtist:
    """Draws each message alone."""

    def __init__(self, messages: Messages, options: Options) -> None:
        self._type = messages.type
        self._options = options

    def draw(self, sighting: Sighting, time: int) -> list[Drawing]:
        """As of Artist."""
        del time
        draw = DRAWN_BY.get(self._type)
        if draw is None:
            raise CannotDrawError(f"there is no display for {self._type}")
        return [draw(sighting.message(), self._options)]

    def fades(self, time: int) -> bool:
        """Never."""
        del time
        return False


class OdometryArtist:
    """Draws the last poses as a trail."""

    def __init__(self, messages: Messages, options: Options) -> None:
        self._news = _News(messages, options.keep)
        self._options = options
        self._trail: deque[Row] = deque(maxlen=options.keep)

    def draw(self, sighting: Sighting, time: int) -> list[Drawing]:
        """As of Artist."""
        del time
        follows, news = self._news.until(sighting)
        if not follows:
            self._trail.clear()
        for one in news:
            message = one.message()
            self._trail.append(pose_row(message.pose.pose))
        return [draw_odometry(sighting.message(), list(self._trail), self._options)]

    def fades(self, time: int) -> bool:
        """Never."""
        del time
        return False


class MarkerArtist:
    """Keeps the set of markers that the messages make up."""

    def __init__(self, messages: Messages, options: Options, mesh_url: MeshUrl) -> None:
        self._news = _News(messages, _MARKER_MESSAGES)
        self._options = options
        self._set = MarkerSet(mesh_url)

    def draw(self, sighting: Sighting, time: int) -> list[Drawing]:
        """As of Artist."""
        follows, news = self._news.until(sighting)
        if not follows:
            self._set.clear()
        for one in news:
            self._set.take(one.message(), one.time)
        self._set.expire(time)
        return self._set.draw(self._options)

    def fades(self, time: int) -> bool:
        """Whether a lifetime is over."""
        return self._set.expires(time)


def artist_for(messages: Messages, options: Options, mesh_url: MeshUrl) -> Artist:
    """Who draws the messages of a topic."""
    if messages.type == "nav_msgs/msg/Odometry":
        return OdometryArtist(messages, options)
    if messages.type.startswith("visualization_msgs/msg/Marker"):
        return MarkerArtist(messages, options, mesh_url)
    return PlainArtist(messages, options)


class _News:
    """The messages that have come since the last question, up to one."""

    def __init__(self, messages: Messages, most: int) -> None:
        self._messages = messages
        self._most = most
        self._last: int | None = None

    def until(self, sighting: Sighting) -> tuple[bool, list[Sighting]]:
        """Whether they follow those before, and the messages; at most so many of the last ones."""
        last, self._last = self._last, sighting.key
        known = [one for one in self._messages.before(sighting.time, self._most) if one.key <= sighting.key]
        known = known or [sighting]
        if last is not None and known[0].key <= last + 1 and last <= sighting.key:
            return True, [one for one in known if one.key > last]
        return False, known
