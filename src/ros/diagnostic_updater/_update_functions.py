# SPDX-License-Identifier: Apache-2.0
"""Tasks that check the rate and the stamps of events."""

import math
import threading
from typing import Any

from diagnostic_msgs.msg import DiagnosticStatus
from diagnostic_updater._diagnostic_status_wrapper import DiagnosticStatusWrapper
from diagnostic_updater._diagnostic_updater import DiagnosticTask
from rclpy.clock import Clock, ClockType, ROSClock

__all__ = ["FrequencyStatus", "FrequencyStatusParam", "Heartbeat", "TimeStampStatus", "TimeStampStatusParam"]


class FrequencyStatusParam:
    """Limits of a rate.

    Args:
        freq_bound: Limits in Hz under the keys "min" and, optionally, "max". They are read at each update.
        tolerance: Fraction by which a rate may be outside the limits.
        window_size: Number of updates over which the rate is averaged.
    """

    def __init__(self, freq_bound: dict[str, float], tolerance: float = 0.1, window_size: int = 5) -> None:
        self.freq_bound = freq_bound
        self.tolerance = tolerance
        self.window_size = window_size


class FrequencyStatus(DiagnosticTask):
    """A task that checks the rate of events.

    Args:
        params: Limits of the rate.
        name: Name of the status.
    """

    def __init__(self, params: FrequencyStatusParam, name: str = "FrequencyStatus") -> None:
        super().__init__(name)
        self.params = params
        self.lock = threading.Lock()
        self.clock = Clock(clock_type=ClockType.STEADY_TIME)
        self.clear()

    def clear(self) -> None:
        """Forget all events."""
        with self.lock:
            self.count = 0
            self.times = [self.clock.now()] * self.params.window_size
            self.seq_nums = [0] * self.params.window_size
            self.hist_indx = 0

    def tick(self) -> None:
        """Count an event."""
        with self.lock:
            self.count += 1

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Report the rate of the events in the window."""
        with self.lock:
            now, oldest = self.clock.now(), self.hist_indx
            events = self.count - self.seq_nums[oldest]
            window = (now - self.times[oldest]).nanoseconds * 1e-9
            self.seq_nums[oldest], self.times[oldest] = self.count, now
            self.hist_indx = (oldest + 1) % self.params.window_size
            total = self.count
        rate = events / window if window > 0.0 else math.inf if events else 0.0
        least = self.params.freq_bound["min"] * (1.0 - self.params.tolerance)
        most = self.params.freq_bound.get("max", math.inf) * (1.0 + self.params.tolerance)
        if events == 0:
            stat.summary(DiagnosticStatus.ERROR, "No events recorded.")
        elif rate < least:
            stat.summary(DiagnosticStatus.WARN, "Frequency too low.")
        elif rate > most:
            stat.summary(DiagnosticStatus.WARN, "Frequency too high.")
        else:
            stat.summary(DiagnosticStatus.OK, "Desired frequency met")
        stat.add("Events in window", events)
        stat.add("Events since startup", total)
        stat.add("Duration of window (s)", f"{window:f}")
        stat.add("Actual frequency (Hz)", f"{rate:f}")
        if self.params.freq_bound.get("max") == self.params.freq_bound["min"]:
            stat.add("Target frequency (Hz)", f"{self.params.freq_bound['min']:f}")
        if least > 0.0:
            stat.add("Minimum acceptable frequency (Hz)", f"{least:f}")
        if "max" in self.params.freq_bound:
            stat.add("Maximum acceptable frequency (Hz)", f"{most:f}")
        return stat


class TimeStampStatusParam:
    """Limits of the delay between a stamp and its check, in seconds.

    Args:
        min_acceptable: Lower limit; stamps in the future have negative delays.
        max_acceptable: Upper limit.
    """

    def __init__(self, min_acceptable: float = -1, max_acceptable: float = 5) -> None:
        self.min_acceptable = min_acceptable
        self.max_acceptable = max_acceptable


class TimeStampStatus(DiagnosticTask):
    """A task that checks the stamps of events.

    Args:
        params: Limits of the delay. None for the limits of `TimeStampStatusParam()`.
        name: Name of the status.

    Attributes:
        clock: Clock with which stamps are compared; ROS time.
    """

    def __init__(self, params: TimeStampStatusParam | None = None, name: str = "Timestamp Status") -> None:
        super().__init__(name)
        self.params = params or TimeStampStatusParam()
        self.clock: Clock = ROSClock()
        self.lock = threading.Lock()
        self.early_count = self.late_count = self.zero_count = 0
        self.__reset()

    def __reset(self) -> None:
        self.zero_seen = False
        self.deltas_valid = False
        self.min_delta = self.max_delta = 0.0

    def tick(self, stamp: Any) -> None:
        """Check a stamp.

        Args:
            stamp: Seconds, a time of rclpy, or a time message.
        """
        seconds = _seconds(stamp)
        with self.lock:
            if seconds == 0.0:
                self.zero_seen = True
                return
            delta = self.clock.now().nanoseconds * 1e-9 - seconds
            self.max_delta = max(delta, self.max_delta) if self.deltas_valid else delta
            self.min_delta = min(delta, self.min_delta) if self.deltas_valid else delta
            self.deltas_valid = True

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Report the stamps since the last update."""
        with self.lock:
            stat.summary(DiagnosticStatus.OK, "Timestamps are reasonable.")
            if not self.deltas_valid:
                stat.summary(DiagnosticStatus.WARN, "No data since last update.")
            elif self.min_delta < self.params.min_acceptable:
                stat.summary(DiagnosticStatus.ERROR, "Timestamps too far in future seen.")
                self.early_count += 1
            if self.deltas_valid and self.max_delta > self.params.max_acceptable:
                stat.summary(DiagnosticStatus.ERROR, "Timestamps too far in past seen.")
                self.late_count += 1
            if self.zero_seen:
                stat.summary(DiagnosticStatus.ERROR, "Zero timestamp seen.")
                self.zero_count += 1
            stat.add("Earliest timestamp delay:", f"{self.min_delta:f}")
            stat.add("Latest timestamp delay:", f"{self.max_delta:f}")
            stat.add("Earliest acceptable timestamp delay:", f"{self.params.min_acceptable:f}")
            stat.add("Latest acceptable timestamp delay:", f"{self.params.max_acceptable:f}")
            stat.add("Late diagnostic update count:", self.late_count)
            stat.add("Early diagnostic update count:", self.early_count)
            stat.add("Zero seen diagnostic update count:", self.zero_count)
            self.__reset()
        return stat


class Heartbeat(DiagnosticTask):
    """A task that reports that the node is running."""

    def __init__(self) -> None:
        super().__init__("Heartbeat")

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Report OK."""
        stat.summary(DiagnosticStatus.OK, "Alive")
        return stat


def _seconds(stamp: Any) -> float:
    if hasattr(stamp, "nanoseconds"):
        return float(stamp.nanoseconds) * 1e-9
    return stamp.sec + stamp.nanosec * 1e-9 if hasattr(stamp, "sec") else float(stamp)
