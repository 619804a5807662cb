# SPDX-License-Identifier: Apache-2.0
"""Rate limit for terminal output, because other nodes can cause more lines than anyone can read."""

from __future__ import annotations

import atexit
import contextlib
import functools
import sys
import threading
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TextIO

__all__ = ["MAX_LINES", "LineLimit", "print_bounded"]

MAX_LINES = 2_000  # per second; a screen shows about 50
_LINE_LENGTH = 1_000  # characters; longer lines count as several


class LineLimit:
    """Writes at most `MAX_LINES` lines per second. Thread-safe.

    A message that does not fit is omitted completely, so that no message is shown in part; only a message that would
    never fit is truncated. Before the next message, a line reports how many lines were omitted.

    Args:
        write: Called with each message to show.
        clock: Returns the time in seconds.
    """

    def __init__(self, write: Callable[[str], object], clock: Callable[[], float] = time.monotonic) -> None:
        self._write = write
        self._clock = clock
        self._lock = threading.Lock()
        self._window_start = clock()
        self._shown_lines = 0  # lines since then
        self.omitted = 0
        """The number of lines that were not shown and not reported yet."""

    def __call__(self, text: str) -> None:
        """Show a message of one or more lines, without a trailing newline, or count its lines as omitted."""
        with self._lock:
            if self._clock() - self._window_start >= 1.0:
                self._report_omitted()
                self._window_start, self._shown_lines = self._clock(), 0
            lines = text.split("\n")
            left = MAX_LINES - self._shown_lines
            fitting = _count_fitting_lines(lines, left)
            if fitting < len(lines) and (self._shown_lines or fitting == 0):
                self.omitted += len(lines)
                return
            self._shown_lines += sum(map(_line_weight, lines[:fitting]))
            self.omitted += len(lines) - fitting
            self._write("\n".join(lines[:fitting]))

    def close(self) -> None:
        """Report how many lines were not shown since the last report."""
        with self._lock:
            self._report_omitted()

    def _report_omitted(self) -> None:
        if self.omitted:
            omitted, self.omitted = self.omitted, 0
            self._write(f"... {omitted} more lines not shown, because more than {MAX_LINES} arrived in a second")


def print_bounded(text: str, *, error: bool = False) -> None:
    """Print output caused by other nodes: at most `MAX_LINES` lines per second to a terminal, all lines to a file.

    Args:
        text: One or more lines, without a trailing newline.
        error: Whether to print on the standard error.
    """
    stream = _stream(error)
    if stream.isatty():
        _limit(error)(text)
    else:
        print(text, file=stream, flush=True)


def _count_fitting_lines(lines: list[str], room: int) -> int:
    """Return how many of the first lines can be shown."""
    for number, line in enumerate(lines):
        room -= _line_weight(line)
        if room < 0:
            return number
    return len(lines)


def _line_weight(line: str) -> int:
    return 1 + len(line) // _LINE_LENGTH


def _stream(error: bool) -> TextIO:
    return sys.stderr if error else sys.stdout


@functools.cache
def _limit(error: bool) -> LineLimit:
    limit = LineLimit(lambda text: print(text, file=_stream(error), flush=True))
    atexit.register(_close, limit)
    return limit


def _close(limit: LineLimit) -> None:
    with contextlib.suppress(OSError, ValueError):  # The terminal is gone, or the stream is closed.
        limit.close()
