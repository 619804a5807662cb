"""The messages of a topic, as displays ask for them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["Messages", "Sighting"]


class Sighting(NamedTuple):
    """A message of a topic.

    Attributes:
        key: Tells it from all others of the topic.
        time: Where it lies on the timeline, in nanoseconds.
        message: The message.
    """

    key: int
    time: int
    message: Any


class Messages(Protocol):
    """The messages of one topic. Asked by any thread."""

    type: str

    def at(self, time: int) -> Sighting | None:
        """The last message at or before a time in nanoseconds; 0 is the newest of all."""

    def before(self, time: int, count: int) -> list[Sighting]:
        """The last messages at or before a time, the oldest first, at most so many."""

    def times(self) -> NDArray[np.int64]:
        """Where all messages lie on the timeline, in order."""

    def close(self) -> None:
        """Ends it."""
