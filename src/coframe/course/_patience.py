# SPDX-License-Identifier: Apache-2.0
"""A real-time limit that is fair on a busy machine."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["FairTimeout"]

_MAX_FACTOR = 4  # multiple of the limit after which time is up in any case


class FairTimeout:
    """A time limit for a program that excludes the time it waits for a processor."""

    def __init__(self, seconds: float, waiting_time: Callable[[], float]) -> None:
        """Start the timer.

        Args:
            seconds: The limit.
            waiting_time: Returns how long the program has waited for a processor, in seconds.
        """
        self._seconds = seconds
        self._waiting_time = waiting_time
        self._start = time.monotonic()
        self._last_waiting_time = waiting_time()

    def is_over(self) -> bool:
        """Return whether the time is up."""
        passed = time.monotonic() - self._start
        if passed < self._seconds:
            return False
        return (
            passed > _MAX_FACTOR * self._seconds
            or passed - (self._waiting_time() - self._last_waiting_time) > self._seconds
        )
