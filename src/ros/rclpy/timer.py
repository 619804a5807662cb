# SPDX-License-Identifier: Apache-2.0
"""Timers and rates."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import inspect
import threading
import time
from functools import partial
from typing import TYPE_CHECKING, Any

from coframe._core import Event
from rclpy import _absent
from rclpy._absent import Handle
from rclpy._clock_type import ClockType
from rclpy._destroyable import Destroyable, destroyed_error
from rclpy._interruption import Interruption
from rclpy.exceptions import RCLError, ROSInterruptException
from rclpy.time import Time
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.context import Context


class TimerInfo:
    """Information on a call of a timer, for callbacks with a parameter that is annotated with this class.

    Args:
        expected_call_time: Time at which the call was due, in nanoseconds of the timer's clock.
        actual_call_time: Time of the call.
        clock_type: Type of the clock.

    Raises:
        TypeError: The type is not a `ClockType`.
        ValueError: A time is negative.
    """

    def __init__(
        self,
        *,
        expected_call_time: int = 0,
        actual_call_time: int = 0,
        clock_type: ClockType = ClockType.SYSTEM_TIME,
    ) -> None:
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        if expected_call_time < 0 or actual_call_time < 0:
            raise ValueError("call time values must not be negative")
        self._expected_call_time = Time(nanoseconds=expected_call_time, clock_type=clock_type)
        self._actual_call_time = Time(nanoseconds=actual_call_time, clock_type=clock_type)

    @property
    def expected_call_time(self) -> Time:
        """The time at which the call was due."""
        return self._expected_call_time

    @property
    def actual_call_time(self) -> Time:
        """The time of the call."""
        return self._actual_call_time


# With `from __future__ import annotations`, an annotation is a text.
_INFO_ANNOTATIONS = (TimerInfo, "TimerInfo", "timer.TimerInfo", "rclpy.timer.TimerInfo")


class Timer(Destroyable):
    """Timer with a periodic callback. Create it with `Node.create_timer`.

    The period is measured in simulated time while a simulator sets the clock, otherwise in steady time. Setting the
    system clock therefore does not disturb timers.
    """

    handle = Handle()

    def __init__(
        self,
        callback: Callable[..., Any] | None,
        callback_group: CallbackGroup | None,
        timer_period_ns: int,
        clock: Clock,
        *,
        context: Context | None = None,
        autostart: bool = True,
    ) -> None:
        if timer_period_ns < 0:
            raise RCLError("failed to create timer: timer period must be non-negative")
        if timer_period_ns >= 2**63:
            raise TypeError(
                f"The period of {timer_period_ns} ns is too large: the maximum is 2**63 - 1 ns, or 292 years."
            )
        self.callback = callback
        self.callback_group = callback_group
        self.__clock = clock
        self.__context = context or get_default_context()
        self.__period_ns = int(timer_period_ns)
        self.__is_canceled = not autostart
        self._Coframe__destruction = Interruption()
        self.__lock = threading.Lock()
        self._Coframe__ended_periods = 0
        self.__start()

    @property
    def callback(self) -> Callable[..., Any] | None:
        """The function that is called at the end of each period."""
        return self.__callback

    @callback.setter
    def callback(self, value: Callable[..., Any] | None) -> None:
        self.__callback = value
        self.__info_parameter = None if value is None else _info_parameter(value)

    @property
    def clock(self) -> Clock:
        """The clock that measures the period."""
        return self.__clock

    @property
    def timer_period_ns(self) -> int:
        """The period in nanoseconds. A change takes effect after the next call."""
        return self.__period_ns

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        self.__period_ns = int(value)
        self.__context._Coframe__wakeup.set()

    def destroy(self) -> None:
        """Destroy the timer. Prefer `Node.destroy_timer`."""
        self._Coframe__destruction.set()

    def cancel(self) -> None:
        """Stop the callbacks until `reset()`."""
        self.__check_not_destroyed()
        self.__is_canceled = True

    def is_canceled(self) -> bool:
        """Return whether the timer was cancelled."""
        self.__check_not_destroyed()
        return self.__is_canceled

    def reset(self) -> None:
        """Restart the period from now. This also restarts a cancelled timer."""
        self.__check_not_destroyed()
        self.__start()
        self.__is_canceled = False
        self.__context._Coframe__wakeup.set()

    def is_ready(self) -> bool:
        """Return whether a call is due."""
        self.__check_not_destroyed()
        return self.__is_due()

    def time_since_last_call(self) -> int:
        """Return the nanoseconds since the last call, or since the start."""
        self.__check_not_destroyed()
        self.__follow_clock()
        return self._Coframe__now_ns() - self.__last_ns

    def time_until_next_call(self) -> int | None:
        """Return the nanoseconds until the next call, negative if it is late, or None if the timer is cancelled."""
        self.__check_not_destroyed()
        return None if self.__is_canceled else self._Coframe__until_next_ns()

    def __is_due(self) -> bool:
        return not self._Coframe__is_stopped and self._Coframe__until_next_ns() <= 0

    def __check_not_destroyed(self) -> None:
        if self._Coframe__destruction.is_set:
            raise destroyed_error("The timer")

    def _Coframe__until_next_ns(self) -> int:
        """Return the nanoseconds until the next call, even if the timer is cancelled."""
        self.__follow_clock()
        return self.__next_ns - self._Coframe__now_ns()

    def __start(self) -> None:
        self._Coframe__is_simulated = self.__clock._Coframe__is_simulated
        self.__last_ns = self._Coframe__now_ns()
        self.__next_ns = self.__last_ns + self.__period_ns

    @property
    def _Coframe__is_stopped(self) -> bool:
        return self.__is_canceled or self._Coframe__destruction.is_set

    def _Coframe__now_ns(self) -> int:
        return self.__clock._Coframe__now_ns() if self._Coframe__is_simulated else time.monotonic_ns()

    def __follow_clock(self) -> None:
        """Restart the period if the time source changed or simulated time jumped back."""
        if (
            self._Coframe__is_simulated != self.__clock._Coframe__is_simulated
            or self._Coframe__now_ns() < self.__last_ns
        ):
            self.__start()

    def _Coframe__remaining_ns(self) -> int | None:
        if self._Coframe__is_stopped:
            return None
        remaining = self._Coframe__until_next_ns()
        # A simulated clock advances when a message arrives, which also sets the wakeup.
        return None if self._Coframe__is_simulated and remaining > 0 else remaining

    def _Coframe__take(self) -> Callable[[], Any] | None:
        expected = self.__next_ns
        if not self._Coframe__end_period():
            return None
        if self.__info_parameter is None:
            return self.__callback
        return partial(self.__call_with_info, self.__info_parameter, expected)

    def __call_with_info(self, parameter: str, expected: int) -> Any:
        if self.__callback is None:
            return None
        # The period is measured in steady time. The times are those of the timer's clock.
        now = self.__clock._Coframe__now_ns()
        due = now - max(self._Coframe__now_ns() - expected, 0)
        info = TimerInfo(
            expected_call_time=max(due, 0), actual_call_time=max(now, 0), clock_type=self.__clock.clock_type
        )
        return self.__callback(**{parameter: info})

    def _Coframe__end_period(self) -> bool:
        """Schedule the next call if one is due now. Missed periods are skipped."""
        with self.__lock:
            if not self.__is_due():
                return False
            now = self._Coframe__now_ns()
            self.__last_ns = now
            self.__next_ns += self.__period_ns
            if self.__next_ns < now:
                late = now - self.__next_ns
                self.__next_ns = (
                    now if self.__period_ns == 0 else self.__next_ns + (late // self.__period_ns + 1) * self.__period_ns
                )
            self._Coframe__ended_periods += 1
            return True


def _info_parameter(callback: Callable[..., Any]) -> str | None:
    """Return the name of the parameter that is annotated with `TimerInfo`, or None if there is none."""
    try:
        parameters = inspect.signature(callback).parameters.values()
    except (TypeError, ValueError):  # Some built-in functions have no signature.
        return None
    return next((each.name for each in parameters if each.annotation in _INFO_ANNOTATIONS), None)


class Rate(Destroyable):
    """Rate that sleeps to run a loop at a frequency. Create it with `Node.create_rate`.

    Its timer belongs to the node, so `rclpy.spin_once(node)` returns at the end of each period. `sleep()` returns at
    once if the executor has ended the period already. Without a spinning node it sleeps itself, unless a simulator
    sets the clock.
    """

    def __init__(self, timer: Timer, *, context: Context) -> None:
        self.__timer = timer
        self.__context = context
        self.__ended_periods = timer._Coframe__ended_periods
        self.__was_destroyed_alone = False

    def sleep(self) -> None:
        """Sleep until the end of the current period, or until the rate is destroyed.

        Raises:
            ROSInterruptException: The context was shut down, or the node was destroyed.
            RuntimeError: The rate was destroyed before.
        """
        timer, context, ended, event = self.__timer, self.__context, self.__ended_periods, Event()
        if context.ok() and timer._Coframe__is_stopped:
            raise RuntimeError("Rate cannot sleep because it has been destroyed")
        with (
            context._Coframe__shutdown.wakes(event),
            timer._Coframe__destruction.wakes(event),
            timer.clock._Coframe__jump_sets(event),
        ):
            while True:
                if not context.ok():
                    raise ROSInterruptException
                has_ended = timer._Coframe__ended_periods != ended or timer._Coframe__end_period()
                if has_ended or self.__was_destroyed_alone:
                    break
                if timer._Coframe__is_stopped:
                    raise ROSInterruptException
                if (remaining := timer._Coframe__until_next_ns()) > 0:
                    event.wait(None if timer._Coframe__is_simulated else remaining)
        self.__ended_periods = timer._Coframe__ended_periods

    def destroy(self) -> None:
        """Destroy the rate. Prefer `Node.destroy_rate`."""
        # A node that is destroyed has destroyed the timer before.
        self.__was_destroyed_alone |= not self.__timer._Coframe__destruction.is_set
        self.__timer.destroy()


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
