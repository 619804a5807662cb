"""What all tabs share: the source with its scene, the topics, and the origin of times."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from coframe.viewer.scene import Scene

if TYPE_CHECKING:
    from coframe.viewer.sources import Source, Topic

__all__ = ["Stage"]

# How often the structure is looked at, and how often the topics.
STRUCTURE_PERIOD, TOPICS_PERIOD = 0.2, 1.0
# A float64 is exact up to 2**53 nanoseconds, 104 days.
_FARTHEST = 2**52


class Stage:
    """What all tabs see; used by one thread.

    Args:
        source: What is viewed.
        fixed: The fixed frame that was asked for; "" for the root of the largest tree.
    """

    def __init__(self, source: Source, *, fixed: str = "") -> None:
        self.source = source
        self.scene = Scene(source.buffer, ages=source.mode == "live")
        self.fixed = fixed
        self.rviz: dict[str, Any] | None = None
        self.topics: list[Topic] = []
        self.origin = time.time_ns()
        self._structure_due = self._topics_due = 0.0
        self.refresh()

    @property
    def can_publish(self) -> bool:
        """Whether joint states can be sent."""
        return self.source.mode == "live"

    def refresh(self) -> None:
        """Takes in what has changed, now and then."""
        now = time.monotonic()
        if now >= self._structure_due:
            self._structure_due = now + STRUCTURE_PERIOD
            self.scene.refresh()
            self._choose_origin()
        if now >= self._topics_due:
            self._topics_due = now + TOPICS_PERIOD
            self.topics = self.source.topics()

    def relative_span(self) -> list[int] | None:
        """From when until when there are dynamic transforms, relative to the origin."""
        span = self.scene.span
        return None if span is None else [end - self.origin for end in span]

    def _choose_origin(self) -> None:
        span = self.scene.span
        if span is not None and abs(span[1] - self.origin) > _FARTHEST:
            self.origin = span[1]
