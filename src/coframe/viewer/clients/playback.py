"""The playhead: which time a tab looks at."""

from __future__ import annotations

import time
from dataclasses import dataclass

__all__ = ["Playhead"]

Span = tuple[int, int]

_SLOWEST, _FASTEST = 0.01, 100.0


@dataclass
class Playhead:
    """Live, or at a time that stands still or runs. Times are nanoseconds.

    Attributes:
        live: Whether the newest is looked at.
        playing: Whether the time runs.
        speed: How fast, beside the time of the world.
        loop: Where it begins anew, and where it jumps back; None where it stops at the end.
    """

    live: bool = True
    playing: bool = False
    speed: float = 1.0
    loop: Span | None = None
    _at: int = 0
    _since: int = 0  # of the monotonic clock, when it was at `_at`

    def go_live(self) -> None:
        """Looks at the newest from now on."""
        self.live, self.playing = True, False

    def move(self, at: int, *, playing: bool = False, speed: float = 1.0, loop: Span | None = None) -> None:
        """Looks at a time, from which on it may run."""
        self.live, self.playing = False, playing
        self.speed = min(max(speed, _SLOWEST), _FASTEST)
        self.loop = loop if loop is not None and loop[0] < loop[1] else None
        self._at, self._since = at, time.monotonic_ns()

    def at(self, span: Span | None) -> int:
        """The time that is looked at, within the span of what there is; not for who looks at the newest."""
        if not self.playing:
            return self._at
        now = self._at + round((time.monotonic_ns() - self._since) * self.speed)
        if self.loop is not None and now > self.loop[1]:
            first, last = self.loop
            now = first + (now - first) % (last - first)
            self.move(now, playing=True, speed=self.speed, loop=self.loop)
        elif span is not None and now >= span[1]:
            now = max(span[1], self._at)
        return now
