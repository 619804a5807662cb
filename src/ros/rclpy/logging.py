"""Loggers and their levels."""

from __future__ import annotations

from rclpy._arguments import LoggingArguments
from rclpy.impl.console import console
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.impl.rcutils_logger import RcutilsLogger

__all__ = [
    "LoggingSeverity",
    "clear_config",
    "get_logger",
    "get_logger_effective_level",
    "get_logging_severity_from_string",
    "initialize",
    "set_logger_level",
    "shutdown",
]

_loggers: dict[str, RcutilsLogger] = {}


def get_logger(name: str) -> RcutilsLogger:
    """Returns the logger of a name, the same one each time.

    Raises:
        ValueError: The name is empty.
    """
    if not name:
        raise ValueError("Logger name must not be empty.")
    return _loggers.setdefault(name, RcutilsLogger(name))


def set_logger_level(name: str, level: int, detailed_error: bool = False) -> None:
    """Sets the least severity that a logger logs.

    Args:
        name: Name of the logger.
        level: A LoggingSeverity.
        detailed_error: Accepted for upstream's sake; errors are always detailed.
    """
    del detailed_error
    console.levels[name] = LoggingSeverity(level)


def get_logger_effective_level(name: str) -> LoggingSeverity:
    """Returns the least severity that a logger logs, inherited or its own."""
    return console.effective_level(name)


def get_logging_severity_from_string(log_severity: str) -> LoggingSeverity:
    """Returns the severity of a name such as "WARN".

    Raises:
        RuntimeError: There is none of this name.
    """
    try:
        return LoggingSeverity[log_severity.upper()]
    except KeyError:
        names = ", ".join(LoggingSeverity.__members__)
        raise RuntimeError(f"no logging severity {log_severity!r}; there are {names}") from None


def initialize() -> None:
    """Makes logging ready; it always is."""


def shutdown() -> None:
    """Ends logging; there is nothing to end."""


def clear_config() -> None:
    """Forgets all levels."""
    _configure(LoggingArguments())


def _configure(arguments: LoggingArguments) -> None:
    console.default_level = arguments.default_level or LoggingSeverity.INFO
    console.levels = dict(arguments.levels)
    console.writes_to_terminal = arguments.stdout
