# SPDX-License-Identifier: Apache-2.0
"""Rate-limited warnings about events that other nodes can cause at any rate, such as invalid messages."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable

REPEAT_AFTER: Final = 10.0  # seconds


class CountedWarning:
    """A warning that is issued at most every 10 s, with the number of events. Thread-safe.

    Args:
        warn: Called with each warning.
        clock: Returns the time in seconds.
    """

    def __init__(self, warn: Callable[[str], object], clock: Callable[[], float] = time.monotonic) -> None:
        self._warn = warn
        self._clock = clock
        self._lock = threading.Lock()
        self._next = clock()
        self._omitted = 0

    def __call__(self, text: str) -> None:
        """Issue the warning, or only count it if the last one is too recent."""
        with self._lock:
            if self._clock() < self._next:
                self._omitted += 1
                return
            self._next = self._clock() + REPEAT_AFTER
            omitted, self._omitted = self._omitted, 0
        self._warn(f"{text} {omitted} more since the last warning." if omitted else text)
