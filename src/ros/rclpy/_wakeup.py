# SPDX-License-Identifier: Apache-2.0
"""Wake-up condition on which executors wait for work."""

from __future__ import annotations

import threading
import time

from coframe._core import Event
from rclpy.constants import S_TO_NS


class Wakeup:
    """Wake-up condition of a context. Waitables set it, and all executors of the context wait for it.

    The native event can be set from any thread and from signal handlers, but only one thread can wait for it. The
    first executor that waits becomes the leader: it waits for the event and then wakes the other executors, which wait
    for the count to change.
    """

    def __init__(self) -> None:
        self.event = Event()
        self._condition = threading.Condition()
        self._count = 0
        self._has_leader = False

    @property
    def count(self) -> int:
        """Number of observed wake-ups. Read it before looking for work, and pass it to `wait`."""
        return self._count

    def set(self) -> None:
        """Wake all waiting executors. This is safe in a signal handler."""
        self.event.set()

    def wait(self, seen: int, timeout_ns: int | None) -> None:
        """Wait until the count differs from `seen`, for at most `timeout_ns` nanoseconds (None: no limit)."""
        deadline = None if timeout_ns is None else time.monotonic_ns() + timeout_ns
        while self._count == seen:
            remaining = None if deadline is None else deadline - time.monotonic_ns()
            if remaining is not None and remaining <= 0:
                return
            self._wait_once(seen, remaining)

    def _wait_once(self, seen: int, timeout_ns: int | None) -> None:
        with self._condition:
            if self._count != seen:
                return
            if self._has_leader:
                self._condition.wait(None if timeout_ns is None else timeout_ns / S_TO_NS)
                return
            self._has_leader = True
        was_set = False
        try:
            was_set = self.event.wait(timeout_ns)
        finally:
            with self._condition:
                self._has_leader = False
                self._count += was_set
                self._condition.notify_all()

    def wait_until_idle(self) -> None:
        """Wait until no thread is in native code, where the shutdown of the interpreter would be fatal."""
        with self._condition:
            self._condition.wait_for(lambda: not self._has_leader, timeout=1.0)
