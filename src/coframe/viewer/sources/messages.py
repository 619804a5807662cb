"""The messages of a topic, as displays ask for them: by time, or the newest."""

from __future__ import annotations

import itertools
import threading
import time
from bisect import bisect_right
from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from coframe.viewer.sources.adaptive_subscription import AdaptiveSubscription

__all__ = ["LiveMessages", "Messages", "Sighting"]


class Sighting(NamedTuple):
    """A message of a topic.

    Attributes:
        key: Tells it from all others of the topic.
        time: Where it lies on the timeline, in nanoseconds.
        message: Gives the message; raises ValueError where its bytes are not of its type.
    """

    key: int
    time: int
    message: Callable[[], Any]


class Messages(Protocol):
    """The messages of one topic; may be asked by any thread."""

    type: str

    def frame(self, name: str) -> str:
        """What a frame that a message names is called among the transforms."""

    def pending(self) -> bool:
        """Whether messages have come that are yet to be taken: what is asked next may take a while."""

    def at(self, time: int) -> Sighting | None:
        """The last message at or before a time in nanoseconds; 0 is the newest of all."""

    def before(self, time: int, count: int) -> list[Sighting]:
        """The last messages at or before a time, 0 is the newest, the oldest first, at most so many."""

    def times(self) -> NDArray[np.int64]:
        """Where all messages lie on the timeline, in order."""

    def close(self) -> None:
        """Ends it."""


class _Stored(NamedTuple):
    key: int
    time: int
    data: bytes


class LiveMessages:
    """The last messages of a topic, as bytes until somebody wants to see them.

    Args:
        subscription: Where they come from.
        ros_type: Their type.
        keep: For how many nanoseconds they are kept, beside the newest.
        frame: What a frame that a message names is called among the transforms.
    """

    MOST_BYTES = 64 << 20
    MOST = 4000

    def __init__(
        self, subscription: AdaptiveSubscription, ros_type: str, keep: int, frame: Callable[[str], str]
    ) -> None:
        # Imported here because only the displays of messages need the message classes.
        from coframe.messages import deserialize, find  # noqa: PLC0415
        from coframe.messages.header_peek import stamp_reader  # noqa: PLC0415

        self.type = ros_type
        self._subscription = subscription
        self._class = find(ros_type)
        self._deserialize = deserialize
        self._stamp_reader = stamp_reader(ros_type)
        self._keep = keep
        self._frame = frame
        self._stored: deque[_Stored] = deque()
        self._bytes = 0
        self._keys = itertools.count(1)
        self._taking = threading.Lock()  # may last, as messages may be large
        self._lock = threading.Lock()

    def frame(self, name: str) -> str:
        """What a frame that a message names is called among the transforms."""
        return self._frame(name)

    def pending(self) -> bool:
        """Whether messages have come that are yet to be taken: what is asked next may take a while."""
        return self._subscription.pending()

    def at(self, time: int) -> Sighting | None:
        """The last message at or before a time in nanoseconds; 0 is the newest of all."""
        self._take()
        with self._lock:
            if not self._stored:
                return None
            index = self._index_behind(time) - 1
            return None if index < 0 else self._sighting(self._stored[index])

    def before(self, time: int, count: int) -> list[Sighting]:
        """The last messages at or before a time, 0 is the newest, the oldest first, at most so many."""
        self._take()
        with self._lock:
            end = self._index_behind(time)
            return [self._sighting(one) for one in itertools.islice(self._stored, max(0, end - count), end)]

    def times(self) -> NDArray[np.int64]:
        """Where all messages lie on the timeline, in order."""
        self._take()
        with self._lock:
            return np.array([stored.time for stored in self._stored], np.int64)

    def close(self) -> None:
        """Leaves the topic."""
        self._subscription.close()

    def _take(self) -> None:
        if not self._subscription.pending():
            return
        with self._taking:
            samples = self._subscription.take()
            with self._lock:
                for sample in samples:
                    self._store(sample.data)

    def _store(self, data: bytes) -> None:
        stamp = self._stamp_reader.stamp(data) if self._stamp_reader else None
        if stamp is None or stamp <= 0:
            stamp = time.time_ns()
        # The timeline goes forward: what comes late lies where it came.
        newest = self._stored[-1].time if self._stored else stamp
        if stamp < newest - self._keep:  # a simulation that began anew
            self._stored.clear()
            self._bytes = 0
            newest = stamp
        self._stored.append(_Stored(next(self._keys), max(stamp, newest), data))
        self._bytes += len(data)
        self._forget()

    def _forget(self) -> None:
        newest = self._stored[-1].time
        while len(self._stored) > 1 and (
            self._stored[0].time < newest - self._keep or self._bytes > self.MOST_BYTES or len(self._stored) > self.MOST
        ):
            self._bytes -= len(self._stored.popleft().data)

    def _index_behind(self, time: int) -> int:
        if time == 0:
            return len(self._stored)
        return bisect_right(self._stored, time, key=lambda stored: stored.time)

    def _sighting(self, stored: _Stored) -> Sighting:
        return Sighting(stored.key, stored.time, lambda: self._deserialize(stored.data, self._class))
