# SPDX-License-Identifier: Apache-2.0
"""Waitables: entities of users' own, made of guard conditions, timers, subscriptions, clients and services."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy import _absent
from rclpy._absent import entity_of
from rclpy._destroyable import Destroyable

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.executors import ExecutorEntity
    from rclpy.task import Future

__all__ = ["NumberOfEntities", "WaitSet", "Waitable"]


class NumberOfEntities:
    """Numbers of entities of each kind that a waitable adds to a wait set."""

    def __init__(
        self,
        num_subs: int = 0,
        num_gcs: int = 0,
        num_timers: int = 0,
        num_clients: int = 0,
        num_services: int = 0,
        num_events: int = 0,
    ) -> None:
        self.num_subscriptions = num_subs
        self.num_guard_conditions = num_gcs
        self.num_timers = num_timers
        self.num_clients = num_clients
        self.num_services = num_services
        self.num_events = num_events

    def __add__(self, other: NumberOfEntities) -> NumberOfEntities:
        result = NumberOfEntities()
        for name in vars(result):
            setattr(result, name, getattr(self, name) + getattr(other, name))
        return result

    def __iadd__(self, other: NumberOfEntities) -> NumberOfEntities:  # noqa: PYI034 - as upstream
        vars(self).update(vars(self + other))
        return self

    def __repr__(self) -> str:
        return f"NumberOfEntities({', '.join(str(number) for number in vars(self).values())})"


class WaitSet:
    """Entities that a waitable waits for. An executor passes it to `add_to_wait_set` and `is_ready`.

    Each `add_...` method takes an entity or its `handle` and returns the index for `is_ready`.
    """

    def __init__(self) -> None:
        self._entities: dict[str, list[ExecutorEntity]] = {}

    def add_subscription(self, subscription: Any) -> int:
        """Add a subscription."""
        return self._add("subscription", subscription)

    def add_guard_condition(self, guard_condition: Any) -> int:
        """Add a guard condition."""
        return self._add("guard_condition", guard_condition)

    def add_timer(self, timer: Any) -> int:
        """Add a timer."""
        return self._add("timer", timer)

    def add_client(self, client: Any) -> int:
        """Add a service client."""
        return self._add("client", client)

    def add_service(self, service: Any) -> int:
        """Add a service."""
        return self._add("service", service)

    def add_event(self, event: Any) -> int:
        """Add an event handler."""
        return self._add("event", event)

    def is_ready(self, entity_type: str, index: int) -> bool:
        """Return whether the entity with this index is ready.

        Args:
            entity_type: `subscription`, `guard_condition`, `timer`, `client`, `service` or `event`.
            index: Result of the `add_...` method.

        Raises:
            IndexError: There is no such entity.
        """
        remaining = self._entities.get(entity_type, [])[index]._Coframe__remaining_ns()
        return remaining is not None and remaining <= 0

    def remaining_ns(self) -> int | None:
        """Return the nanoseconds until the next timer is ready, 0 or less if an entity is ready now, or None."""
        times = [entity._Coframe__remaining_ns() for entities in self._entities.values() for entity in entities]
        return min((time for time in times if time is not None), default=None)

    def reset_triggers(self) -> None:
        """Reset the guard conditions and restart the timers that were ready, as waiting does in upstream rclpy."""
        for kind in ("guard_condition", "timer"):
            for entity in self._entities.get(kind, []):
                entity._Coframe__take()

    def _add(self, kind: str, entity: Any) -> int:
        entity = entity_of(entity)
        if not hasattr(entity, "_Coframe__remaining_ns"):
            raise TypeError(f"A wait set takes entities of rclpy, not {type(entity).__name__}.")
        entities = self._entities.setdefault(kind, [])
        entities.append(entity)
        return len(entities) - 1


class Waitable(Destroyable):
    """Base class of a user's own waitables. Add an instance with `Node.add_waitable`.

    An executor calls `add_to_wait_set` and `is_ready`. If the waitable is ready, it calls `take_data` and then
    `execute` in a task.

    Args:
        callback_group: Group that controls when `execute` may run.
    """

    def __init__(self, callback_group: CallbackGroup) -> None:
        self.callback_group = callback_group
        self.callback_group.add_entity(self)
        self._futures: list[Future[Any]] = []
        self.__wait_set = WaitSet()

    def destroy(self) -> None:
        """Do nothing at the end of a `with` block. A waitable with entities of its own overrides this."""

    def add_future(self, future: Future[Any]) -> None:
        """Keep a future of this waitable."""
        self._futures.append(future)

    def remove_future(self, future: Future[Any]) -> None:
        """Remove a future that `add_future` added.

        Raises:
            ValueError: The future was not added.
        """
        self._futures.remove(future)

    def is_ready(self, wait_set: WaitSet) -> bool:
        """Return whether the entities that were added to the wait set make this waitable ready."""
        raise NotImplementedError("Must be implemented by subclass")

    def take_data(self) -> Any:
        """Return the data for `execute`."""
        raise NotImplementedError("Must be implemented by subclass")

    async def execute(self, taken_data: Any) -> None:
        """Handle the result of `take_data`."""
        raise NotImplementedError("Must be implemented by subclass")

    def get_num_entities(self) -> NumberOfEntities:
        """Return how many entities `add_to_wait_set` adds."""
        raise NotImplementedError("Must be implemented by subclass")

    def add_to_wait_set(self, wait_set: WaitSet) -> None:
        """Add the entities that this waitable waits for."""
        raise NotImplementedError("Must be implemented by subclass")

    def _Coframe__remaining_ns(self) -> int | None:
        self.__wait_set = WaitSet()
        self.add_to_wait_set(self.__wait_set)
        if self.is_ready(self.__wait_set):
            return 0
        remaining = self.__wait_set.remaining_ns()
        # The waitable has seen that an entity is ready, and waits for something else.
        return remaining if remaining is not None and remaining > 0 else None

    def _Coframe__take(self) -> Callable[[], Any] | None:
        self.__wait_set.reset_triggers()
        return partial(self.execute, self.take_data())


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
