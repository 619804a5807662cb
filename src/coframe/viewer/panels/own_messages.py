# SPDX-License-Identifier: Apache-2.0
"""The log messages of the viewer itself."""

from __future__ import annotations

import logging
from collections import deque
from typing import TYPE_CHECKING, NamedTuple

from coframe.time import SECOND

if TYPE_CHECKING:
    from coframe.viewer.protocol.common import LogLevel

__all__ = ["LEVELS", "MAX_LINES", "MAX_TEXT", "LogLine", "OwnMessages"]

MAX_LINES = 2_000
MAX_TEXT = 2_000
LEVELS: dict[int, LogLevel] = {10: "debug", 20: "info", 30: "warning", 40: "error", 50: "fatal"}
"""The levels of ROS 2 and of Python."""
_OWN_LOGGERS = ("coframe.viewer", "coframe.wire")


class LogLine(NamedTuple):
    """A log message. The stamp is in nanoseconds."""

    stamp: int
    level: LogLevel
    node: str
    text: str
    place: str


class OwnMessages(logging.Filter):
    """Collects the viewer's own log messages without changing how they are logged."""

    def __init__(self) -> None:
        super().__init__()
        self._lines: deque[LogLine] = deque(maxlen=MAX_LINES)
        for name in _OWN_LOGGERS:
            logging.getLogger(name).addFilter(self)

    def filter(self, record: logging.LogRecord) -> bool:
        """Store a record. See logging.Filter."""
        level = LEVELS.get(record.levelno // 10 * 10, "info")
        text = record.getMessage()
        if record.exc_info and record.exc_info[1] is not None:
            text += f"\n{type(record.exc_info[1]).__name__}: {record.exc_info[1]}"
        place = f"{record.filename}:{record.lineno}"
        self._lines.append(LogLine(int(record.created * SECOND), level, record.name, text[:MAX_TEXT], place))
        return True

    def take(self) -> list[LogLine]:
        """Return the messages since the last call."""
        lines = []
        while self._lines:
            lines.append(self._lines.popleft())
        return lines

    def close(self) -> None:
        """Stop collecting."""
        for name in _OWN_LOGGERS:
            logging.getLogger(name).removeFilter(self)
