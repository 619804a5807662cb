# SPDX-License-Identifier: Apache-2.0
"""A limit on real time that is fair on a busy machine."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Patience"]

_MAX_FACTOR = 4  # times the limit, after which it is over in any case


class Patience:
    """A limit on the time that a program has for something, without the time that it waits for a processor."""

    def __init__(self, seconds: float, waiting_time: Callable[[], float]) -> None:
        """Start the time.

        Args:
            seconds: The limit.
            waiting_time: Returns how long the program has waited for a processor so far, in seconds.
        """
        self._seconds = seconds
        self._waiting_time = waiting_time
        self._start = time.monotonic()
        self._waited = waiting_time()

    def is_over(self) -> bool:
        """Return whether the time is over."""
        passed = time.monotonic() - self._start
        if passed < self._seconds:
            return False
        return passed > _MAX_FACTOR * self._seconds or passed - (self._waiting_time() - self._waited) > self._seconds
