# SPDX-License-Identifier: Apache-2.0
"""Loggers and log levels."""

from __future__ import annotations

import os
from functools import partial
from pathlib import Path

from rclpy import _absent
from rclpy._arguments import LoggingArguments
from rclpy.exceptions import _with_hint
from rclpy.impl.console import console
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.impl.rcutils_logger import RcutilsLogger

__all__ = [
    "LoggingSeverity",
    "clear_config",
    "get_logger",
    "get_logger_effective_level",
    "get_logger_level",
    "get_logging_directory",
    "get_logging_severity_from_string",
    "initialize",
    "set_logger_level",
    "shutdown",
]

_loggers: dict[str, RcutilsLogger] = {}


def get_logger(name: str) -> RcutilsLogger:
    """Return the logger with this name. Each name has one logger.

    Raises:
        ValueError: The name is empty.
    """
    if not name:
        raise ValueError("Logger name must not be empty.")
    return _loggers.setdefault(name, RcutilsLogger(name))


def set_logger_level(name: str, level: int, detailed_error: bool = False) -> None:
    """Set the lowest severity that a logger logs.

    Args:
        name: Name of the logger.
        level: A LoggingSeverity.
        detailed_error: Ignored, accepted for compatibility. Errors are always detailed.
    """
    del detailed_error
    console.levels[name] = LoggingSeverity(level)


def get_logger_effective_level(name: str) -> LoggingSeverity:
    """Return the lowest severity that a logger logs, which may be inherited."""
    return console.effective_level(name)


def get_logger_level(name: str) -> LoggingSeverity:
    """Return the level that was set for a logger; UNSET if it inherits its level."""
    return LoggingSeverity(console.levels.get(name, LoggingSeverity.UNSET))


def get_logging_severity_from_string(log_severity: str) -> LoggingSeverity:
    """Return the severity with a name such as "WARN".

    Raises:
        RuntimeError: No severity has this name.
    """
    try:
        return LoggingSeverity[log_severity.upper()]
    except KeyError:
        names = ", ".join(LoggingSeverity.__members__)
        error = RuntimeError("Failed to get severity name")
        raise _with_hint(error, f"{log_severity!r} is not one of {names}.") from None


def get_logging_directory() -> Path:
    """Return the folder of ROS's log files: ROS_LOG_DIR, `log` in ROS_HOME, or `~/.ros/log`.

    coframe writes no log files. Programs with their own log files use this folder.
    """
    if folder := os.environ.get("ROS_LOG_DIR"):
        return Path(folder).expanduser()
    return Path(os.environ.get("ROS_HOME") or "~/.ros").expanduser() / "log"


def initialize() -> None:
    """Initialize logging. This does nothing, because logging is always available."""


def shutdown() -> None:
    """Shut down logging. This does nothing, because there is nothing to release."""


def clear_config() -> None:
    """Reset all levels to the defaults."""
    _configure(LoggingArguments())


def _configure(arguments: LoggingArguments) -> None:
    console.default_level = arguments.default_level or LoggingSeverity.INFO
    console.levels = dict(arguments.levels)
    console.writes_to_terminal = arguments.stdout


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
