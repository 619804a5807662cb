"""What one run of a statement takes.

Nothing but the standard library: peers are timed by this in Pythons of their own.
"""

import time
import timeit
from collections.abc import Callable
from typing import Any

SAMPLE_NS = 400_000
"""Short enough to fit between two switches of the scheduler."""
LONG_NS = 20_000_000
"""A run that takes so long needs no other one to warm up."""


class Statement:
    """A statement in a bare loop, timed by its thread's processor time.

    Args:
        code: The statement; it is compiled into the loop, so that no call is added to what it does.
        names: What it may use.
        setup: Runs before each sample and is not timed; what it assigns, the statement may use.
        items: How many things one run does: the time is told for one of them.
        limit: How many runs one setup is good for.
        clock: Nanoseconds. `time.process_time_ns` counts helping threads, `time.perf_counter_ns` is the wall's.
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
        """Nanoseconds an item, from about `SAMPLE_NS` of runs and at least one."""
        if not self._runs:
            self._runs = self._runs_of_a_sample()
        if not self._long:
            self._spend(1)  # the caches were the other contender's
        return self._spend(self._runs) / (self._runs * self._items)

    def _spend(self, runs: int) -> int:
        return max(int(self._timer.timeit(runs)), 1)

    def _runs_of_a_sample(self) -> int:
        self._long = self._spend(1) > LONG_NS
        runs = 1
        while runs < self._limit and min(self._spend(runs), self._spend(runs)) < SAMPLE_NS * 0.7:
            runs = min(2 * runs, self._limit)
        return runs
