"""Timers and rates."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.clock import Clock
from rclpy.context import Context
from rclpy.exceptions import ROSInterruptException
from rclpy.time import Time
from rclpy.utilities import get_default_context


class Timer:
    """Calls back periodically; made by `Node.create_timer`.

    While a simulator drives its clock, the period counts in simulated time, else in steady time: setting the
    computer's clock does not disturb a timer.
    """

    def __init__(
        self,
        callback: Callable[[], Any] | None,
        callback_group: CallbackGroup,
        timer_period_ns: int,
        clock: Clock,
        *,
        context: Context | None = None,
    ) -> None:
        if timer_period_ns < 0:
            raise ValueError("timer period must not be negative")
        self.callback = callback
        self.callback_group = callback_group
        self._clock = clock
        self._context = context or get_default_context()
        self._period_ns = int(timer_period_ns)
        self._is_canceled = False
        self._is_destroyed = False
        self._start()

    @property
    def clock(self) -> Clock:
        """The clock of the period."""
        return self._clock

    @property
    def timer_period_ns(self) -> int:
        """The period in nanoseconds; a new one counts from the next call on."""
        return self._period_ns

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        self._period_ns = int(value)
        self._context._wakeup.set()

    def destroy(self) -> None:
        """Ends it; better use `Node.destroy_timer`."""
        self._is_destroyed = True

    def cancel(self) -> None:
        """Stops calling back until `reset()`."""
        self._is_canceled = True

    def is_canceled(self) -> bool:
        """Whether it was stopped."""
        return self._is_canceled

    def reset(self) -> None:
        """Starts a full period from now, also of a cancelled timer."""
        self._start()
        self._is_canceled = False
        self._context._wakeup.set()

    def is_ready(self) -> bool:
        """Whether a call is due."""
        return not self._is_stopped and self.time_until_next_call_ns() <= 0

    def time_since_last_call(self) -> int:
        """Returns nanoseconds since the last call, or since the start."""
        self._follow_clock()
        return self._now_ns() - self._last_ns

    def time_until_next_call(self) -> int | None:
        """Returns nanoseconds until the next call is due, negative when it is late; None when cancelled."""
        return None if self._is_canceled else self.time_until_next_call_ns()

    def time_until_next_call_ns(self) -> int:
        """Returns nanoseconds until the next call is due, whether or not it was cancelled."""
        self._follow_clock()
        return self._next_ns - self._now_ns()

    def _start(self) -> None:
        self._is_simulated = self._clock._is_simulated
        self._last_ns = self._now_ns()
        self._next_ns = self._last_ns + self._period_ns

    @property
    def _is_stopped(self) -> bool:
        return self._is_canceled or self._is_destroyed

    def _now_ns(self) -> int:
        return self._clock._now_ns() if self._is_simulated else time.monotonic_ns()

    def _follow_clock(self) -> None:
        """Starts anew when the source of time changed, or a simulation was started over."""
        if self._is_simulated != self._clock._is_simulated or self._now_ns() < self._last_ns:
            self._start()

    def _remaining_ns(self) -> int | None:
        if self._is_stopped:
            return None
        remaining = self.time_until_next_call_ns()
        # A simulated clock moves when a message comes, which sets the wakeup.
        return None if self._is_simulated and remaining > 0 else remaining

    def _take(self) -> Callable[[], Any] | None:
        if not self.is_ready():
            return None
        self._advance()
        return self.callback

    def _advance(self) -> None:
        """Counts one call; periods that were missed altogether are left out."""
        now = self._now_ns()
        self._last_ns = now
        self._next_ns += self._period_ns
        if self._next_ns < now:
            late = now - self._next_ns
            self._next_ns = now if self._period_ns == 0 else self._next_ns + (late // self._period_ns + 1) * self._period_ns


class Rate:
    """Sleeps to keep a loop at a frequency; made by `Node.create_rate`.

    Needs nobody to spin, unless a simulator drives the clock.
    """

    def __init__(self, timer: Timer, *, context: Context) -> None:
        self._timer = timer
        self._context = context

    def sleep(self) -> None:
        """Sleeps until the current period is over.

        Raises:
            ROSInterruptException: The context was shut down.
        """
        while (remaining := self._timer.time_until_next_call_ns()) > 0:
            if not self._context.ok():
                raise ROSInterruptException
            clock = self._timer.clock
            # Clocks refuse times before their epoch only: now + remaining is always one.
            clock._sleep(Time(nanoseconds=clock._now_ns() + remaining, clock_type=clock.clock_type), self._context)
        self._timer._advance()

    def destroy(self) -> None:
        """Ends it."""
        self._timer.destroy()
