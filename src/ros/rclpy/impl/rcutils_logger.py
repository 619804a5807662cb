"""Loggers, with the filters `once`, `throttle_duration_sec` and `skip_first` for each place in the code."""

# The modules of rclpy share what its users do not see.
# ruff: noqa: SLF001

from __future__ import annotations

import sys
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from rclpy.impl.console import Record, console
from rclpy.impl.logging_severity import LoggingSeverity

if TYPE_CHECKING:
    from types import FrameType

    from rclpy.clock import Clock

_OPTIONS: Final = ("once", "throttle_duration_sec", "throttle_time_source_type", "skip_first")


@dataclass
class _CallSite:
    """What the filters remember about one place in the code."""

    severity: LoggingSeverity
    name: str
    options: dict[str, Any]
    last_ns: int | None = None
    calls: int = field(default=0)

    def lets_pass(self) -> bool:
        """Whether this call is to be logged."""
        self.calls += 1
        if self.options.get("skip_first") and self.calls == 1:
            return False
        if self.options.get("once") and self.last_ns is not None:
            return False
        clock: Clock | None = self.options.get("throttle_time_source_type")
        now = time.time_ns() if clock is None else clock.now().nanoseconds
        period = int(self.options.get("throttle_duration_sec", 0) * 1e9)
        # A clock that went back starts a new period.
        if self.last_ns is not None and self.last_ns <= now < self.last_ns + period:
            return False
        self.last_ns = now
        return True


class RcutilsLogger:
    """Logs under a name; levels are inherited along the dots of names.

    Args:
        name: Dotted name; empty: the root of all.
    """

    def __init__(self, name: str = "") -> None:
        self.name = name
        # Of this logger alone: two nodes of one class log from the same lines.
        self._call_sites: dict[tuple[str, int, int], _CallSite] = {}
        self._children: dict[str, RcutilsLogger] = {}

    def get_child(self, name: str) -> RcutilsLogger:
        """Returns the logger `name` below this one.

        Raises:
            ValueError: The name is empty.
        """
        if not name:
            raise ValueError("Child logger name must not be None or empty.")
        return self._children.setdefault(name, RcutilsLogger(f"{self.name}.{name}" if self.name else name))

    def set_level(self, level: int) -> None:
        """Sets the least severity that is logged; UNSET inherits it again."""
        console.levels[self.name] = LoggingSeverity(level)

    def get_effective_level(self) -> LoggingSeverity:
        """Returns the least severity that is logged."""
        return console.effective_level(self.name)

    def is_enabled_for(self, severity: int) -> bool:
        """Whether messages of this severity are logged."""
        return self.get_effective_level() <= severity

    def log(self, message: object, severity: int, name: str | None = None, **kwargs: Any) -> bool:
        """Logs a message.

        Args:
            message: The text.
            severity: A LoggingSeverity.
            name: Logged under this name instead of the logger's own.
            **kwargs: `once=True`; `throttle_duration_sec=` with, if wished, `throttle_time_source_type=` (a Clock);
                `skip_first=True`. They hold for the place in the code where they stand.

        Returns:
            Whether it was logged.

        Raises:
            TypeError: An option is unknown or incomplete.
            ValueError: The same place in the code now uses another severity, name or other filters.
        """
        severity = LoggingSeverity(severity)
        name = name or self.name
        if console.effective_level(name) > severity:
            return False
        frame = _caller()
        if kwargs and not self._call_site(frame, severity, name, kwargs).lets_pass():
            return False
        console.emit(Record(time.time_ns(), severity, name, str(message), frame.f_code, frame.f_lineno))
        return True

    def debug(self, message: object, **kwargs: Any) -> bool:
        """Logs with severity DEBUG; see `log`."""
        return self.log(message, LoggingSeverity.DEBUG, **kwargs)

    def info(self, message: object, **kwargs: Any) -> bool:
        """Logs with severity INFO; see `log`."""
        return self.log(message, LoggingSeverity.INFO, **kwargs)

    def warning(self, message: object, **kwargs: Any) -> bool:
        """Logs with severity WARN; see `log`."""
        return self.log(message, LoggingSeverity.WARN, **kwargs)

    def warn(self, message: object, **kwargs: Any) -> bool:
        """Logs with severity WARN; the older name of `warning`."""
        return self.log(message, LoggingSeverity.WARN, **kwargs)

    def error(self, message: object, **kwargs: Any) -> bool:
        """Logs with severity ERROR; see `log`."""
        return self.log(message, LoggingSeverity.ERROR, **kwargs)

    def fatal(self, message: object, **kwargs: Any) -> bool:
        """Logs with severity FATAL; see `log`."""
        return self.log(message, LoggingSeverity.FATAL, **kwargs)

    def _call_site(self, frame: FrameType, severity: LoggingSeverity, name: str, options: dict[str, Any]) -> _CallSite:
        for option in options:
            if option not in _OPTIONS:
                raise TypeError(f'parameter "{option}" is not one of the recognized logging options "{list(_OPTIONS)}"')
        if "throttle_time_source_type" in options and "throttle_duration_sec" not in options:
            raise TypeError(
                'required parameter "throttle_duration_sec" not specified but is required for the the logging filter '
                '"throttle"'
            )
        key = (frame.f_code.co_filename, frame.f_lineno, frame.f_lasti)
        site = self._call_sites.setdefault(key, _CallSite(severity, name, options))
        if site.severity != severity:
            raise ValueError("Logger severity cannot be changed between calls.")
        if site.name != name:
            raise ValueError("Logger name cannot be changed between calls.")
        if site.options.keys() != options.keys():
            raise ValueError("Logging filters cannot be changed between calls.")
        return site


def _caller() -> FrameType:
    frame = sys._getframe(1)
    while frame.f_code.co_filename == __file__ and frame.f_back is not None:
        frame = frame.f_back
    return frame
