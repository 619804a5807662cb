# SPDX-License-Identifier: Apache-2.0
"""Console output of log records: levels by logger name, ROS's line format and colors."""

from __future__ import annotations

import os
import sys
import time
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Final, TextIO

from coframe.time import MILLISECOND, SECOND
from rclpy import _absent
from rclpy.impl.logging_severity import LoggingSeverity

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import CodeType

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
    """A log message.

    Attributes:
        stamp: Time of the message in nanoseconds since the Unix epoch.
        severity: Severity of the message.
        name: Name of the logger.
        message: Text of the message.
        code: Code object that logged the message.
        line: Line number of the call.
    """

    stamp: int
    severity: LoggingSeverity
    name: str
    message: str
    code: CodeType
    line: int


class Console:
    """Output and level configuration shared by all loggers of the process."""

    def __init__(self) -> None:
        self.default_level = LoggingSeverity.INFO
        self.levels: dict[str, LoggingSeverity] = {}
        self.writes_to_terminal = True
        # Additional sinks (/rosout) by logger name. Each receives the records of this logger and of its children.
        self.sinks: dict[str, Callable[[Record], None]] = {}

    def effective_level(self, name: str) -> LoggingSeverity:
        """Return the level of the logger, of its nearest ancestor that has one, or the default level."""
        for ancestor in _with_ancestors(name):
            level = self.levels.get(ancestor, LoggingSeverity.UNSET)
            if level is not LoggingSeverity.UNSET:
                return level
        return self.default_level

    def emit(self, record: Record) -> None:
        """Write the record to the terminal and pass it to the sink of its logger."""
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
    if stream is None:  # There is no stderr under pythonw and in some daemons.
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
    """Replace the tokens of an rcutils format string. Unknown tokens are kept."""
    seconds, nanoseconds = divmod(record.stamp, SECOND)
    date = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(seconds))
    tokens = {
        "{severity}": record.severity.name,
        "{name}": record.name,
        "{time}": f"{seconds}.{nanoseconds:09d}",
        "{time_as_nanoseconds}": str(record.stamp),
        "{date_time_with_ms}": f"{date}.{nanoseconds // MILLISECOND:03d}",
        "{function_name}": record.code.co_name,
        "{file_name}": record.code.co_filename,
        "{line_number}": str(record.line),
    }
    # The message is inserted last, so that text in it that looks like a token is not replaced.
    head, separator, tail = template.partition("{message}")
    for token, value in tokens.items():
        head, tail = head.replace(token, value), tail.replace(token, value)
    return head + (record.message if separator else "") + tail


console: Final = Console()

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
