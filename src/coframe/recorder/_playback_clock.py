# SPDX-License-Identifier: Apache-2.0
"""The clock of a replay: recorded time that can be paused, stepped, scaled and stopped."""

from __future__ import annotations

import threading
import time

from coframe.time import SECOND

__all__ = ["PlaybackClock"]

_MAX_WAIT = 3600.0  # seconds; the operating system rejects waits that are longer than a month


class PlaybackClock:
    """The recorded time during a replay. It starts with the first call of `jump`.

    Times are nanoseconds. All methods are thread-safe.

    Args:
        start: The initial recorded time.
        rate: Recorded seconds per real second.
        paused: Whether the clock is paused at first.
    """

    def __init__(self, start: int, rate: float, *, paused: bool) -> None:
        self._changed = threading.Condition()
        self._base_time = start
        self._start_time: int | None = None
        self._rate = rate
        self._is_paused = paused
        self._steps = 0
        self._is_stopped = False
        self._is_interrupted = False

    @property
    def now(self) -> int:
        """The current recorded time."""
        with self._changed:
            return self._now()

    @property
    def rate(self) -> float:
        """Recorded seconds per real second."""
        return self._rate

    @property
    def paused(self) -> bool:
        """Whether the clock is paused."""
        return self._is_paused

    @property
    def steps(self) -> int:
        """The number of steps that have not been taken."""
        return self._steps

    @property
    def stopped(self) -> bool:
        """Whether `stop` was called."""
        return self._is_stopped

    def jump(self, to: int) -> None:
        """Set the recorded time and start the clock."""
        with self._changed:
            self._base_time, self._start_time = to, time.monotonic_ns()
            self._changed.notify_all()

    def set_rate(self, rate: float) -> None:
        """Set the rate: recorded seconds per real second."""
        with self._changed:
            self._restart_from_now()
            self._rate = rate
            self._changed.notify_all()

    def set_paused(self, paused: bool) -> None:
        """Pause the clock, or resume it."""
        with self._changed:
            self._restart_from_now()
            self._is_paused = paused
            self._steps = 0
            self._changed.notify_all()

    def step(self, number: int = 1) -> None:
        """Let some calls of `wait_until` return while the clock is paused."""
        with self._changed:
            if self._is_paused:
                self._steps += number
                self._changed.notify_all()

    def interrupt(self) -> None:
        """Let the current or the next call of `wait_until` return False, once."""
        with self._changed:
            self._is_interrupted = True
            self._changed.notify_all()

    def stop(self) -> None:
        """Stop the clock. All current and future waits return immediately."""
        with self._changed:
            self._is_stopped = True
            self._changed.notify_all()

    def wait_until(self, moment: int) -> bool:
        """Wait for a recorded time or a step. Return False if the clock is stopped or interrupted."""
        with self._changed:
            while not self._is_stopped:
                if self._is_interrupted:
                    self._is_interrupted = False
                    return False
                if self._is_paused:
                    if self._steps:
                        self._steps -= 1
                        self._base_time = max(self._base_time, moment)
                        return True
                    self._changed.wait()
                    continue
                left = (moment - self._now()) / self._rate / SECOND
                if left <= 0:
                    return True
                self._changed.wait(min(left, _MAX_WAIT))
            return False

    def sleep(self, seconds: float) -> bool:
        """Wait in real time, even if paused. Return False if the clock is stopped."""
        with self._changed:
            return not self._changed.wait_for(lambda: self._is_stopped, min(seconds, threading.TIMEOUT_MAX))

    def _now(self) -> int:
        if self._is_paused or self._start_time is None:
            return self._base_time
        return self._base_time + int((time.monotonic_ns() - self._start_time) * self._rate)

    def _restart_from_now(self) -> None:
        self._base_time = self._now()
        self._start_time = None if self._start_time is None else time.monotonic_ns()
