"""What all tabs share: the source with its scene, the topics, and the origin of times."""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

from coframe.viewer.meshes import MeshTable
from coframe.viewer.scene import Scene

if TYPE_CHECKING:
    from coframe.viewer.messages import Messages
    from coframe.viewer.rviz import RvizConfig
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
        meshes: Where meshes may come from; None: from nowhere.
        rviz: What a tab shows at first.
    """

    def __init__(
        self, source: Source, *, fixed: str = "", meshes: MeshTable | None = None, rviz: RvizConfig | None = None
    ) -> None:
        self.source = source
        self.meshes = MeshTable(lambda _name: None) if meshes is None else meshes
        self.scene = Scene(source.buffer, ages=source.mode == "live")
        self.rviz = rviz
        self.fixed = fixed or (rviz.fixed_frame if rviz is not None else "")
        self.saved_rviz: str | None = None
        self.topics: list[Topic] = []
        self.origin = time.time_ns()
        self.executor = ThreadPoolExecutor(2, "coframe-viewer-work")
        self._open: dict[str, _Shared] = {}
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

    def open(self, topic: str) -> Messages | None:
        """The messages of a topic, which all tabs share; None while there is none of that name."""
        shared = self._open.get(topic)
        if shared is None:
            messages = self.source.open(topic)
            if messages is None:
                return None
            shared = self._open[topic] = _Shared(messages)
        shared.users += 1
        return shared.messages

    def release(self, topic: str) -> None:
        """Gives back what `open` gave."""
        shared = self._open[topic]
        shared.users -= 1
        if shared.users == 0:
            del self._open[topic]
            shared.messages.close()

    def close(self) -> None:
        """Ends what is still at work for tabs that have gone."""
        for topic in list(self._open):
            self._open.pop(topic).messages.close()
        self.executor.shutdown(wait=True, cancel_futures=True)

    def _choose_origin(self) -> None:
        span = self.scene.span
        if span is not None and abs(span[1] - self.origin) > _FARTHEST:
            self.origin = span[1]


class _Shared:
    """The messages of a topic, and how many displays look at them."""

    def __init__(self, messages: Messages) -> None:
        self.messages = messages
        self.users = 0
