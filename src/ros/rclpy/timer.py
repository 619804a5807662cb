# SPDX-License-Identifier: Apache-2.0
"""Timers and rates."""

# The modules of rclpy use each other's private members.
# ruff: noqa: SLF001

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from rclpy.exceptions import ROSInterruptException
from rclpy.time import Time
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.context import Context


class Timer:
    """Timer with a periodic callback. Create it with `Node.create_timer`.

    The period is measured in simulated time while a simulator sets the clock, otherwise in steady time. Setting the
    system clock therefore does not disturb timers.
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
        """The clock that measures the period."""
        return self._clock

    @property
    def timer_period_ns(self) -> int:
        """The period in nanoseconds. A change takes effect after the next call."""
        return self._period_ns

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        self._period_ns = int(value)
        self._context._wakeup.set()

    def destroy(self) -> None:
        """Destroy the timer. Prefer `Node.destroy_timer`."""
        self._is_destroyed = True

    def cancel(self) -> None:
        """Stop the callbacks until `reset()`."""
        self._is_canceled = True

    def is_canceled(self) -> bool:
        """Return whether the timer was cancelled."""
        return self._is_canceled

    def reset(self) -> None:
        """Restart the period from now. This also restarts a cancelled timer."""
        self._start()
        self._is_canceled = False
        self._context._wakeup.set()

    def is_ready(self) -> bool:
        """Return whether a call is due."""
        return not self._is_stopped and self.time_until_next_call_ns() <= 0

    def time_since_last_call(self) -> int:
        """Return the nanoseconds since the last call, or since the start."""
        self._follow_clock()
        return self._now_ns() - self._last_ns

    def time_until_next_call(self) -> int | None:
        """Return the nanoseconds until the next call, negative if it is late, or None if the timer is cancelled."""
        return None if self._is_canceled else self.time_until_next_call_ns()

    def time_until_next_call_ns(self) -> int:
        """Return the nanoseconds until the next call, even if the timer is cancelled."""
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
        """Restart the period if the time source changed or simulated time jumped back."""
        if self._is_simulated != self._clock._is_simulated or self._now_ns() < self._last_ns:
            self._start()

    def _remaining_ns(self) -> int | None:
        if self._is_stopped:
            return None
        remaining = self.time_until_next_call_ns()
        # A simulated clock advances when a message arrives, which also sets the wakeup.
        return None if self._is_simulated and remaining > 0 else remaining

    def _take(self) -> Callable[[], Any] | None:
        if not self.is_ready():
            return None
        self._advance()
        return self.callback

    def _advance(self) -> None:
        """Schedule the next call. Missed periods are skipped."""
        now = self._now_ns()
        self._last_ns = now
        self._next_ns += self._period_ns
        if self._next_ns < now:
            late = now - self._next_ns
            self._next_ns = (
                now if self._period_ns == 0 else self._next_ns + (late // self._period_ns + 1) * self._period_ns
            )


class Rate:
    """Rate that sleeps to run a loop at a frequency. Create it with `Node.create_rate`.

    The node needs to be spinning only if a simulator sets the clock.
    """

    def __init__(self, timer: Timer, *, context: Context) -> None:
        self._timer = timer
        self._context = context

    def sleep(self) -> None:
        """Sleep until the end of the current period.

        Raises:
            ROSInterruptException: The context was shut down.
        """
        while (remaining := self._timer.time_until_next_call_ns()) > 0:
            if not self._context.ok():
                raise ROSInterruptException
            clock = self._timer.clock
            # A Time must not be negative, and now + remaining never is.
            clock._sleep(Time(nanoseconds=clock._now_ns() + remaining, clock_type=clock.clock_type), self._context)
        self._timer._advance()

    def destroy(self) -> None:
        """Destroy the rate."""
        self._timer.destroy()
