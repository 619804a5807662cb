"""From a log record to a line on the terminal: levels by logger name, ROS's format, colours."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import CodeType
from typing import Final, TextIO

from rclpy.impl.logging_severity import LoggingSeverity

_DEFAULT_FORMAT: Final = "[{severity}] [{time}] [{name}]: {message}"
_RESET: Final = "\033[0m"
_COLORS: Final = {
    LoggingSeverity.DEBUG: "\033[32m",
    LoggingSeverity.WARN: "\033[33m",
    LoggingSeverity.ERROR: "\033[31m",
    LoggingSeverity.FATAL: "\033[31m",
}


@dataclass(frozen=True)
class Record:
    """One log message: when (ns since 1970), how serious, from whom, and from which line of code."""

    stamp: int
    severity: LoggingSeverity
    name: str
    message: str
    code: CodeType
    line: int


class Console:
    """Where all loggers of the process write."""

    def __init__(self) -> None:
        self.default_level = LoggingSeverity.INFO
        self.levels: dict[str, LoggingSeverity] = {}
        self.writes_to_terminal = True
        # By logger name: who else wants the records of this logger and its children (/rosout).
        self.sinks: dict[str, Callable[[Record], None]] = {}

    def effective_level(self, name: str) -> LoggingSeverity:
        """The level set for the logger, else for its nearest ancestor, else the default."""
        for ancestor in _with_ancestors(name):
            level = self.levels.get(ancestor, LoggingSeverity.UNSET)
            if level is not LoggingSeverity.UNSET:
                return level
        return self.default_level

    def emit(self, record: Record) -> None:
        """Writes the record to the terminal and hands it to the sink of its logger."""
        if self.writes_to_terminal:
            _write(record)
        for ancestor in _with_ancestors(record.name):
            if (sink := self.sinks.get(ancestor)) is not None:
                sink(record)
                return


def _with_ancestors(name: str) -> Iterator[str]:
    while name:
        yield name
        name = name.rpartition(".")[0]


def _write(record: Record) -> None:
    stream = sys.stdout if os.environ.get("RCUTILS_LOGGING_USE_STDOUT") == "1" else sys.stderr
    if stream is None:  # pythonw, daemons
        return
    text = format_record(record, os.environ.get("RCUTILS_CONSOLE_OUTPUT_FORMAT", _DEFAULT_FORMAT))
    if _is_colored(stream):
        text = f"{_COLORS.get(record.severity, _RESET)}{text}{_RESET}"
    stream.write(text + "\n")
    stream.flush()


def _is_colored(stream: TextIO) -> bool:
    choice = os.environ.get("RCUTILS_COLORIZED_OUTPUT")
    return stream.isatty() if choice not in {"0", "1"} else choice == "1"


def format_record(record: Record, template: str) -> str:
    """Fills in the tokens of rcutils; unknown ones stay as they are."""
    seconds, nanoseconds = divmod(record.stamp, 10**9)
    date = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(seconds))
    tokens = {
        "{severity}": record.severity.name,
        "{name}": record.name,
        "{time}": f"{seconds}.{nanoseconds:09d}",
        "{time_as_nanoseconds}": str(record.stamp),
        "{date_time_with_ms}": f"{date}.{nanoseconds // 10**6:03d}",
        "{function_name}": record.code.co_name,
        "{file_name}": record.code.co_filename,
        "{line_number}": str(record.line),
    }
    # The message comes last: tokens inside it are the user's own text.
    head, separator, tail = template.partition("{message}")
    for token, value in tokens.items():
        head, tail = head.replace(token, value), tail.replace(token, value)
    return head + (record.message if separator else "") + tail


console: Final = Console()
