"""Which callbacks may run at the same time."""

from __future__ import annotations

import threading
import weakref
from typing import Any


class CallbackGroup:
    """Base of the groups; made by users through its children."""

    def __init__(self) -> None:
        self.entities: weakref.WeakSet[Any] = weakref.WeakSet()

    def add_entity(self, entity: Any) -> None:
        """Puts a timer, subscription, ... into the group."""
        self.entities.add(entity)

    def has_entity(self, entity: Any) -> bool:
        """Whether it is in the group."""
        return entity in self.entities

    def can_execute(self, entity: Any) -> bool:
        """Whether its callback may run now."""
        raise TypeError(f"{type(self).__name__} does not say what may run; use one of its children for {entity}")

    def beginning_execution(self, entity: Any) -> bool:
        """Claims the right to run its callback; False: not now."""
        return self.can_execute(entity)

    def ending_execution(self, entity: Any) -> None:
        """Gives the right back."""


class ReentrantCallbackGroup(CallbackGroup):
    """Callbacks run in parallel, also the same one with itself."""

    def can_execute(self, entity: Any) -> bool:
        """Always."""
        del entity
        return True


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """One callback of the group at a time."""

    def __init__(self) -> None:
        super().__init__()
        self._active_entity: Any = None
        self._lock = threading.Lock()

    def can_execute(self, entity: Any) -> bool:
        """When no callback of the group is running."""
        assert self.has_entity(entity)
        return self._active_entity is None

    def beginning_execution(self, entity: Any) -> bool:
        """Claims the group; False: another callback has it."""
        with self._lock:
            if self._active_entity is not None:
                return False
            self._active_entity = entity
            return True

    def ending_execution(self, entity: Any) -> None:
        """Frees the group."""
        with self._lock:
            assert self._active_entity is entity
            self._active_entity = None
