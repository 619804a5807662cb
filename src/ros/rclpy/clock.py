# SPDX-License-Identifier: Apache-2.0
"""Clocks: system time, steady time, and ROS time, which a simulator can set."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import threading
import time
from enum import IntEnum
from functools import partial
from typing import TYPE_CHECKING

from coframe._core import Event
from rclpy import _absent
from rclpy._absent import Handle
from rclpy._clock_type import ClockType
from rclpy.duration import Duration
from rclpy.exceptions import NotInitializedException
from rclpy.time import Time
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

    from typing_extensions import Self

    from rclpy.context import Context

__all__ = ["Clock", "ClockChange", "ClockType", "JumpHandle", "JumpThreshold", "ROSClock", "TimeJump"]


class ClockChange(IntEnum):
    """Change of the source of ROS time at a time jump."""

    ROS_TIME_NO_CHANGE = 1
    ROS_TIME_ACTIVATED = 2
    ROS_TIME_DEACTIVATED = 3
    SYSTEM_TIME_NO_CHANGE = 4


class JumpThreshold:
    """Threshold of the time jumps that a callback is called for.

    Args:
        min_forward: Smallest forward jump, a positive duration. None disables forward jumps.
        min_backward: Smallest backward jump, a negative duration. None disables backward jumps.
        on_clock_change: Whether to call when ROS time switches between system time and simulated time.

    Raises:
        ValueError: A duration has the wrong sign, or all thresholds are disabled.
    """

    def __init__(
        self, *, min_forward: Duration | None, min_backward: Duration | None, on_clock_change: bool = True
    ) -> None:
        if min_forward is not None and min_forward.nanoseconds <= 0:
            raise ValueError("min_forward must be a positive non-zero duration")
        if min_backward is not None and min_backward.nanoseconds >= 0:
            raise ValueError("min_backward must be a negative non-zero duration")
        if min_forward is None and min_backward is None and not on_clock_change:
            raise ValueError("At least one jump threshold must be enabled")
        self.min_forward = min_forward
        self.min_backward = min_backward
        self.on_clock_change = on_clock_change

    def _Coframe__is_met_by(self, jump: TimeJump) -> bool:
        if jump.clock_change in {ClockChange.ROS_TIME_ACTIVATED, ClockChange.ROS_TIME_DEACTIVATED}:
            return self.on_clock_change
        if self.min_forward is not None and jump.delta.nanoseconds > 0:
            return jump.delta >= self.min_forward
        if self.min_backward is not None and jump.delta.nanoseconds < 0:
            return jump.delta <= self.min_backward
        return False


class TimeJump:
    """A time jump.

    Args:
        clock_change: Change of the time source.
        delta: The new time minus the old time.
    """

    def __init__(self, clock_change: ClockChange, delta: Duration) -> None:
        self._clock_change = clock_change
        self._delta = delta

    @property
    def clock_change(self) -> ClockChange:
        """Change of the time source."""
        return self._clock_change

    @property
    def delta(self) -> Duration:
        """The new time minus the old time."""
        return self._delta


class JumpHandle:
    """Registration of callbacks for the time jumps of a clock, until `unregister()`; also a context manager."""

    def __init__(
        self,
        *,
        clock: Clock,
        threshold: JumpThreshold,
        pre_callback: Callable[[], object] | None,
        post_callback: Callable[[TimeJump], object] | None,
    ) -> None:
        if not callable(pre_callback) and not callable(post_callback):
            raise ValueError("One of pre_callback or post_callback must be callable")  # noqa: TRY004 - as upstream
        self._clock: Clock | None = clock
        self._threshold = threshold
        self._pre_callback = pre_callback
        self._post_callback = post_callback
        clock._Coframe__jump_handles.append(self)

    def unregister(self) -> None:
        """Unregister the callbacks."""
        if self._clock is not None:
            self._clock._Coframe__jump_handles.remove(self)
            self._clock = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, t: type[BaseException] | None, e: BaseException | None, tb: TracebackType | None) -> None:
        self.unregister()


class Clock:
    """A clock of one type.

    Args:
        clock_type: Type of the clock. ROS_TIME creates a `ROSClock`.

    Raises:
        TypeError: `clock_type` is not a ClockType.
    """

    handle = Handle()

    def __new__(cls, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> Self:
        """Create a ROSClock if `clock_type` is ROS_TIME."""
        kind = ROSClock if clock_type is ClockType.ROS_TIME else cls
        return super().__new__(kind)  # type: ignore[return-value]

    def __init__(self, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> None:
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        self._clock_type = clock_type
        self._Coframe__jump_handles: list[JumpHandle] = []

    @property
    def clock_type(self) -> ClockType:
        """The type of this clock."""
        return self._clock_type

    def __repr__(self) -> str:
        return f"Clock(clock_type={self.clock_type.name})"

    def now(self) -> Time:
        """Return the current time of this clock."""
        return Time(nanoseconds=self._Coframe__now_ns(), clock_type=self.clock_type)

    def create_jump_callback(
        self,
        threshold: JumpThreshold,
        *,
        pre_callback: Callable[[], object] | None = None,
        post_callback: Callable[[TimeJump], object] | None = None,
    ) -> JumpHandle:
        """Register callbacks for time jumps.

        Args:
            threshold: The jumps to call back for.
            pre_callback: Function called without arguments before the jump.
            post_callback: Function called with a TimeJump after the jump.

        Raises:
            ValueError: Neither callback is callable.
        """
        return JumpHandle(clock=self, threshold=threshold, pre_callback=pre_callback, post_callback=post_callback)

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Sleep until this clock reaches a time.

        Args:
            until: Time at which the sleep ends.
            context: Context whose shutdown interrupts the sleep. None: the default context.

        Returns:
            True if the time was reached, or False if the context was shut down or the time source changed.

        Raises:
            ValueError: `until` is a time of another clock type.
            NotInitializedException: The context is not initialized.
        """
        if until.clock_type != self.clock_type:
            raise ValueError("until's clock type does not match this clock's type")
        context = context or get_default_context()
        if not context.ok():
            raise NotInitializedException
        return self._Coframe__sleep(until, context)

    def sleep_for(self, rel_time: Duration, context: Context | None = None) -> bool:
        """Sleep for a duration of this clock; otherwise like `sleep_until`."""
        return self.sleep_until(self.now() + rel_time, context)

    def _Coframe__sleep(self, until: Time, context: Context) -> bool:
        event = Event()
        source_changes: list[TimeJump] = []

        def on_jump(jump: TimeJump) -> None:
            if jump.clock_change in {ClockChange.ROS_TIME_ACTIVATED, ClockChange.ROS_TIME_DEACTIVATED}:
                source_changes.append(jump)
            event.set()

        any_progress = JumpThreshold(min_forward=Duration(nanoseconds=1), min_backward=None)
        with context._Coframe__shutdown.wakes(event), self.create_jump_callback(any_progress, post_callback=on_jump):
            while context.ok() and not source_changes:
                remaining = until.nanoseconds - self._Coframe__now_ns()
                if remaining <= 0:
                    return True
                event.wait(None if self._Coframe__is_simulated else remaining)
        return False

    def _Coframe__jump_sets(self, event: Event) -> JumpHandle:
        """Return a context manager within which each change of simulated time, in either direction, sets the event."""
        any_change = JumpThreshold(min_forward=Duration(nanoseconds=1), min_backward=Duration(nanoseconds=-1))
        return self.create_jump_callback(any_change, post_callback=lambda _: event.set())

    @property
    def _Coframe__is_simulated(self) -> bool:
        """Whether a simulator sets the time, so that it advances only with messages."""
        return False

    def _Coframe__now_ns(self) -> int:
        return time.monotonic_ns() if self._clock_type is ClockType.STEADY_TIME else time.time_ns()


class ROSClock(Clock):
    """Clock of ROS time: system time, unless a simulator sets the time."""

    def __init__(self, *, clock_type: ClockType = ClockType.ROS_TIME) -> None:
        super().__init__(clock_type=clock_type)
        self.__is_active = False
        self.__override_ns = 0
        self.__lock = threading.RLock()

    @property
    def ros_time_is_active(self) -> bool:
        """Whether a simulator sets the time of this clock."""
        return self.__is_active

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        with self.__lock:
            if enabled == self.__is_active:
                return
            offset = self.__override_ns - time.time_ns()
            if enabled:
                jump = TimeJump(ClockChange.ROS_TIME_ACTIVATED, Duration(nanoseconds=offset))
            else:
                jump = TimeJump(ClockChange.ROS_TIME_DEACTIVATED, Duration(nanoseconds=-offset))

            def activate() -> None:
                self.__is_active = enabled

            self.__jump(jump, activate)

    def set_ros_time_override(self, time: Time) -> None:
        """Set the simulated time, which applies while ROS time is active.

        Raises:
            TypeError: `time` is not a Time.
        """
        if not isinstance(time, Time):
            raise TypeError(f"Time must be specified as rclpy.time.Time. Received type: {type(time)}")

        def override() -> None:
            self.__override_ns = time.nanoseconds

        with self.__lock:
            if not self.__is_active:
                override()
                return
            delta = Duration(nanoseconds=time.nanoseconds - self.__override_ns)
            self.__jump(TimeJump(ClockChange.ROS_TIME_NO_CHANGE, delta), override)

    def __jump(self, jump: TimeJump, apply: Callable[[], None]) -> None:
        # A copy, because other threads register callbacks at the same time.
        registered = tuple(self._Coframe__jump_handles)
        handles = [handle for handle in registered if handle._threshold._Coframe__is_met_by(jump)]
        for handle in handles:
            if handle._pre_callback is not None:
                handle._pre_callback()
        apply()
        for handle in handles:
            if handle._post_callback is not None:
                handle._post_callback(jump)

    @property
    def _Coframe__is_simulated(self) -> bool:
        return self.__is_active

    def _Coframe__now_ns(self) -> int:
        return self.__override_ns if self.__is_active else time.time_ns()


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
