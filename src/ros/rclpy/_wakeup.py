"""How executors sleep until there may be something to do."""

from __future__ import annotations

import threading
import time

from coframe._core import Event


class Wakeup:
    """One per context: everything that may be ready sets it, every executor of the context waits for it.

    The native event can be set from DDS threads and from signal handlers, but has room for one waiter only. The first
    executor that waits leads: it waits for the event and then wakes the others, which wait for the count to change.
    """

    def __init__(self) -> None:
        self.event = Event()
        self._condition = threading.Condition()
        self._count = 0
        self._is_led = False

    @property
    def count(self) -> int:
        """How often it has been set, as far as anyone noticed; read it before looking for work."""
        return self._count

    def set(self) -> None:
        """Wakes all who wait; safe in a signal handler."""
        self.event.set()

    def wait(self, seen: int, timeout_ns: int | None) -> None:
        """Waits until the count differs from `seen`, at most `timeout_ns` nanoseconds (None: for ever)."""
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
            if self._is_led:
                self._condition.wait(None if timeout_ns is None else timeout_ns / 1e9)
                return
            self._is_led = True
        was_set = False
        try:
            was_set = self.event.wait(timeout_ns)
        finally:
            with self._condition:
                self._is_led = False
                self._count += was_set
                self._condition.notify_all()

    def wait_until_idle(self) -> None:
        """Waits until nobody is in native code any more, where the end of the interpreter would be fatal."""
        with self._condition:
            self._condition.wait_for(lambda: not self._is_led, timeout=1.0)
