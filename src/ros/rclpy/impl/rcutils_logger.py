# SPDX-License-Identifier: Apache-2.0
"""Loggers with the filters `once`, `throttle_duration_sec` and `skip_first`, applied per call site."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import sys
import time
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from rclpy import _absent
from rclpy._numbers import require_number
from rclpy.constants import S_TO_NS
from rclpy.exceptions import _with_hint
from rclpy.impl.console import Record, console
from rclpy.impl.logging_severity import LoggingSeverity

if TYPE_CHECKING:
    from types import FrameType

    from rclpy.clock import Clock

_OPTIONS: Final = ("throttle_duration_sec", "throttle_time_source_type", "skip_first", "once")


@dataclass
class _CallSite:
    """State of the logging filters of one call site."""

    severity: LoggingSeverity
    name: str
    options: dict[str, Any]
    last_ns: int | None = None  # when the throttle last let a call pass
    was_skipped: bool = False
    was_logged: bool = False

    def should_log(self) -> bool:
        """Update the filters, in the order of upstream, and return whether this call should be logged."""
        if not self._passes_throttle():
            return False
        if self.options.get("skip_first") and not self.was_skipped:
            self.was_skipped = True
            return False
        if self.options.get("once") and self.was_logged:
            return False
        self.was_logged = True
        return True

    def _passes_throttle(self) -> bool:
        if "throttle_duration_sec" not in self.options:
            return True
        clock: Clock | None = self.options.get("throttle_time_source_type")
        now = time.time_ns() if clock is None else clock.now().nanoseconds
        period = int(require_number(self.options["throttle_duration_sec"]) * S_TO_NS)
        # A clock that jumped back starts a new period.
        if self.last_ns is not None and self.last_ns <= now < self.last_ns + period:
            return False
        self.last_ns = now
        return True


class RcutilsLogger:
    """A named logger. Levels are inherited along the dots of the name.

    Args:
        name: Dotted name. An empty name is the root logger.
    """

    def __init__(self, name: str = "") -> None:
        self.name = name
        # Each logger has its own state, because two nodes of the same class log from the same lines.
        self.__call_sites: dict[tuple[str, int, int], _CallSite] = {}
        self.__children: dict[str, RcutilsLogger] = {}

    def get_child(self, name: str) -> RcutilsLogger:
        """Return the child logger `name` of this logger.

        Raises:
            ValueError: The name is empty.
        """
        if not name:
            raise ValueError("Child logger name must not be empty.")
        return self.__children.setdefault(name, RcutilsLogger(f"{self.name}.{name}" if self.name else name))

    def set_level(self, level: int) -> None:
        """Set the lowest severity that is logged. UNSET inherits it from the parent again."""
        console.levels[self.name] = LoggingSeverity(level)

    def get_effective_level(self) -> LoggingSeverity:
        """Return the lowest severity that is logged, which may be inherited."""
        return console.effective_level(self.name)

    def is_enabled_for(self, severity: int) -> bool:
        """Return whether messages of this severity are logged."""
        return self.get_effective_level() <= severity

    def log(self, message: object, severity: int, name: str | None = None, **kwargs: Any) -> bool:
        """Log a message.

        Args:
            message: The text, a string.
            severity: A LoggingSeverity.
            name: Name to log under instead of the logger's own name.
            **kwargs: Filters of this call site: `once=True`, `skip_first=True`, or `throttle_duration_sec=` (seconds),
                optionally with `throttle_time_source_type=` (a Clock).

        Returns:
            Whether the message was logged.

        Raises:
            TypeError: The message is not a string, or an option is unknown or incomplete.
            ValueError: The call site changed its severity, name or filters.
        """
        if type(severity) is not LoggingSeverity:
            severity = LoggingSeverity(severity)
        name = name or self.name
        if console.effective_level(name) > severity:
            return False
        if not isinstance(message, str | bytes | None):
            error = TypeError(f"The message must be a string, got {message!r}.")
            raise _with_hint(error, "Write str(...) or an f-string. ROS 2 does not convert messages either.")
        frame = _caller()
        if not self.__call_site(frame, severity, name, kwargs).should_log():
            return False
        console.emit(Record(time.time_ns(), severity, name, str(message), frame.f_code, frame.f_lineno))
        return True

    def debug(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity DEBUG. See `log`."""
        return self.log(message, LoggingSeverity.DEBUG, **kwargs)

    def info(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity INFO. See `log`."""
        return self.log(message, LoggingSeverity.INFO, **kwargs)

    def warning(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity WARN. See `log`."""
        return self.log(message, LoggingSeverity.WARN, **kwargs)

    def warn(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity WARN. This is the older name of `warning`."""
        return self.log(message, LoggingSeverity.WARN, **kwargs)

    def error(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity ERROR. See `log`."""
        return self.log(message, LoggingSeverity.ERROR, **kwargs)

    def fatal(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity FATAL. See `log`."""
        return self.log(message, LoggingSeverity.FATAL, **kwargs)

    def __call_site(self, frame: FrameType, severity: LoggingSeverity, name: str, options: dict[str, Any]) -> _CallSite:
        for option in options:
            if option not in _OPTIONS:
                raise TypeError(f'parameter "{option}" is not one of the recognized logging options "{list(_OPTIONS)}"')
        if "throttle_time_source_type" in options and "throttle_duration_sec" not in options:
            raise TypeError(
                'required parameter "throttle_duration_sec" not specified but is required for the the logging filter '
                '"throttle"'
            )
        key = (frame.f_code.co_filename, frame.f_lineno, frame.f_lasti)
        site = self.__call_sites.setdefault(key, _CallSite(severity, name, options))
        if site.severity != severity:
            raise ValueError("Logger severity cannot be changed between calls.")
        if site.name != name:
            raise ValueError("Logger name cannot be changed between calls.")
        if site.options.keys() != options.keys():
            raise ValueError("Requested logging filters cannot be changed between calls.")
        return site


def _caller() -> FrameType:
    frame = sys._getframe(1)
    while frame.f_code.co_filename == __file__ and frame.f_back is not None:
        frame = frame.f_back
    return frame


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
