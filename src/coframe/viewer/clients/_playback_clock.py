# SPDX-License-Identifier: Apache-2.0
"""The displayed time of a client."""

from __future__ import annotations

import time
from dataclasses import dataclass

__all__ = ["PlaybackClock"]

Span = tuple[int, int]


@dataclass
class PlaybackClock:
    """The displayed time: the time of the newest data, or a fixed or advancing time. Times are nanoseconds.

    Attributes:
        live: Whether the newest data is shown.
        playing: Whether the time advances.
        speed: The speed relative to real time.
        loop: The span that is repeated, or None if playback continues to the end.
    """

    live: bool = True
    playing: bool = False
    speed: float = 1.0
    loop: Span | None = None
    _at: int = 0
    _since: int = 0  # The monotonic time at which the clock was at `_at`.

    def go_live(self) -> None:
        """Show the newest data."""
        self.live, self.playing = True, False

    def move(self, at: int, *, playing: bool = False, speed: float = 1.0, loop: Span | None = None) -> None:
        """Show a time, and start playback there if `playing` is set."""
        self.live, self.playing = False, playing
        self.speed = speed
        self.loop = loop if loop is not None and loop[0] < loop[1] else None
        self._at, self._since = at, time.monotonic_ns()

    def at(self, span: Span | None) -> int:
        """Return the shown time within the span of the data; meaningless while the newest data is shown."""
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
