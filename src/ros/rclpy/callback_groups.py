# SPDX-License-Identifier: Apache-2.0
"""Callback groups, which control which callbacks may run in parallel."""

from __future__ import annotations

import threading
import weakref
from functools import partial
from typing import Any

from rclpy import _absent


class CallbackGroup:
    """Base class of the callback groups."""

    def __init__(self) -> None:
        self.entities: weakref.WeakSet[Any] = weakref.WeakSet()

    def add_entity(self, entity: Any) -> None:
        """Add a timer, subscription or other entity to the group."""
        self.entities.add(entity)

    def has_entity(self, entity: Any) -> bool:
        """Return whether the entity is in the group."""
        return entity in self.entities

    def can_execute(self, entity: Any) -> bool:
        """Return whether the callback of the entity may run now."""
        raise TypeError(
            f"{type(self).__name__} does not implement can_execute(), called for {entity}. "
            "Use ReentrantCallbackGroup or MutuallyExclusiveCallbackGroup."
        )

    def beginning_execution(self, entity: Any) -> bool:
        """Reserve the execution of the entity's callback. Return False if it must not run now."""
        return self.can_execute(entity)

    def ending_execution(self, entity: Any) -> None:
        """Release the reservation of `beginning_execution`."""


class ReentrantCallbackGroup(CallbackGroup):
    """Group whose callbacks may run in parallel, including several calls of the same callback."""

    def can_execute(self, entity: Any) -> bool:
        """Return True: callbacks may always run."""
        del entity
        return True


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """Group that runs one callback at a time."""

    def __init__(self) -> None:
        super().__init__()
        self.__active_entity: Any = None
        self._lock = threading.Lock()

    def can_execute(self, entity: Any) -> bool:
        """Return whether no callback of the group is running."""
        assert self.has_entity(entity)
        return self.__active_entity is None

    def beginning_execution(self, entity: Any) -> bool:
        """Reserve the group for a callback. Return False if another callback is running."""
        with self._lock:
            if self.__active_entity is not None:
                return False
            self.__active_entity = entity
            return True

    def ending_execution(self, entity: Any) -> None:
        """Release the group."""
        with self._lock:
            assert self.__active_entity is entity
            self.__active_entity = None


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
