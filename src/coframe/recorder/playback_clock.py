"""When what is played is due: a clock of recorded time that can be paused, stepped, sped up and stopped."""

from __future__ import annotations

import threading
import time

__all__ = ["PlaybackClock"]

_LONGEST_WAIT = 3600.0  # seconds: beyond a month, the operating system refuses to wait


class PlaybackClock:
    """Recorded time as it passes while a recording is played, from the first `jump` on.

    Times are nanoseconds; any thread may call.

    Args:
        start: Where it begins.
        rate: Seconds of the recording in a second.
        paused: Whether it stands still at first.
    """

    def __init__(self, start: int, rate: float, *, paused: bool) -> None:
        self._changed = threading.Condition()
        self._base = start
        self._since: int | None = None
        self._rate = rate
        self._paused = paused
        self._steps = 0
        self._stopped = False

    @property
    def now(self) -> int:
        """The recorded time."""
        with self._changed:
            return self._now()

    @property
    def rate(self) -> float:
        """Seconds of the recording in a second."""
        return self._rate

    @property
    def paused(self) -> bool:
        """Whether it stands still."""
        return self._paused

    @property
    def stopped(self) -> bool:
        """Whether `stop` was called."""
        return self._stopped

    def jump(self, to: int) -> None:
        """Goes on from another time."""
        with self._changed:
            self._base, self._since = to, time.monotonic_ns()
            self._changed.notify_all()

    def set_rate(self, rate: float) -> None:
        """Goes on at another rate."""
        with self._changed:
            self._anchor()
            self._rate = rate
            self._changed.notify_all()

    def set_paused(self, paused: bool) -> None:
        """Stands still, or goes on."""
        with self._changed:
            self._anchor()
            self._paused = paused
            self._steps = 0
            self._changed.notify_all()

    def step(self) -> None:
        """Lets one `wait_until` pass although it stands still."""
        with self._changed:
            if self._paused:
                self._steps += 1
                self._changed.notify_all()

    def stop(self) -> None:
        """Ends all waiting, now and from now on."""
        with self._changed:
            self._stopped = True
            self._changed.notify_all()

    def wait_until(self, moment: int) -> bool:
        """Waits for a recorded time, or a step: False once stopped."""
        with self._changed:
            while not self._stopped:
                if self._paused:
                    if self._steps:
                        self._steps -= 1
                        self._base = max(self._base, moment)
                        return True
                    self._changed.wait()
                    continue
                left = (moment - self._now()) / self._rate * 1e-9
                if left <= 0:
                    return True
                self._changed.wait(min(left, _LONGEST_WAIT))
            return False

    def sleep(self, seconds: float) -> bool:
        """Waits, whether it stands still or not: False once stopped."""
        with self._changed:
            return not self._changed.wait_for(lambda: self._stopped, seconds)

    def _now(self) -> int:
        if self._paused or self._since is None:
            return self._base
        return self._base + int((time.monotonic_ns() - self._since) * self._rate)

    def _anchor(self) -> None:
        self._base = self._now()
        self._since = None if self._since is None else time.monotonic_ns()
