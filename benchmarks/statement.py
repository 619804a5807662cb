# SPDX-License-Identifier: Apache-2.0
"""Times a statement.

This module uses only the standard library, because it also runs in the Python of a peer.
"""

import time
import timeit
from collections.abc import Callable
from typing import Any

SAMPLE_NS = 400_000
"""Duration of a sample: short enough to fit into a time slice of the scheduler."""
LONG_NS = 20_000_000
"""A run of at least this duration needs no warm-up run."""


class Statement:
    """A statement in a loop, timed by the processor time of its thread.

    Args:
        code: The statement. It is compiled into the loop, so that no function call is added.
        names: The names that it can use.
        setup: Code that runs before each sample and is not timed. The statement can use the names it assigns.
        items: Number of items per run; the result is the time per item.
        limit: Maximum number of runs after one setup.
        clock: Returns nanoseconds: `time.process_time_ns` for all threads, `time.perf_counter_ns` for wall time.
    """

    def __init__(
        self,
        code: str,
        names: dict[str, Any],
        *,
        setup: str = "pass",
        items: int = 1,
        limit: int = 1_000_000,
        clock: Callable[[], int] = time.thread_time_ns,
    ) -> None:
        self._timer = timeit.Timer(code, setup, clock, names)
        self._items = items
        self._limit = limit
        self._runs = 0
        self._long = False

    def sample(self) -> float:
        """Return nanoseconds per item, from runs of about `SAMPLE_NS` in total, at least one run."""
        if not self._runs:
            self._runs = self._runs_of_a_sample()
        if not self._long:
            self._spend(1)  # Fills the caches, which the other contender used.
        return self._spend(self._runs) / (self._runs * self._items)

    def _spend(self, runs: int) -> int:
        return max(int(self._timer.timeit(runs)), 1)

    def _runs_of_a_sample(self) -> int:
        self._long = self._spend(1) > LONG_NS
        runs = 1
        while runs < self._limit and min(self._spend(runs), self._spend(runs)) < SAMPLE_NS * 0.7:
            runs = min(2 * runs, self._limit)
        return runs
