# SPDX-License-Identifier: Apache-2.0
"""Calls a function when several participants are ready."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["ReadyAggregator"]


class ReadyAggregator:
    """Calls a function once, after `ready_fn` was called a number of times.

    Args:
        ready_fn: The function.
        num_to_aggregate: The number of calls.
    """

    def __init__(self, ready_fn: Callable[[], object], num_to_aggregate: int) -> None:
        self._callback = ready_fn
        self._remaining = num_to_aggregate
        self._lock = threading.Lock()

    def ready_fn(self) -> None:
        """Report that one more participant is ready."""
        with self._lock:
            self._remaining -= 1
            is_last = self._remaining == 0
        if is_last:
            self._callback()
