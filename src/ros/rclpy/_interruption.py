# SPDX-License-Identifier: Apache-2.0
"""Events that end a wait early, for example the shutdown of a context or the destruction of a timer."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe._core import Event


class Interruption:
    """A state that is entered once and wakes the threads that wait.

    Attributes:
        is_set: Whether the state was entered.
    """

    def __init__(self) -> None:
        self.is_set = False
        self._events: set[Event] = set()

    def set(self) -> None:
        """Enter the state. A signal handler may call this, because it acquires no lock."""
        self.is_set = True
        for event in tuple(self._events):
            event.set()

    @contextmanager
    def wakes(self, event: Event) -> Iterator[None]:
        """Set the event if the state is entered within the block, or was entered before."""
        self._events.add(event)
        if self.is_set:
            event.set()
        try:
            yield
        finally:
            self._events.discard(event)
