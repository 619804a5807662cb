# SPDX-License-Identifier: Apache-2.0
"""The entities of a node, which it lists and destroys, and for which its executor waits."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any, TypeVar

from rclpy._destroyable import LoggingEntity, destroyed_error
from rclpy.callback_groups import CallbackGroup, MutuallyExclusiveCallbackGroup
from rclpy.client import Client
from rclpy.exceptions import RCLError, _with_hint
from rclpy.guard_condition import GuardCondition
from rclpy.publisher import Publisher
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.timer import Rate, Timer
from rclpy.waitable import Waitable

if TYPE_CHECKING:
    from rclpy.context import Context
    from rclpy.event_handler import EventHandler, MismatchReporter
    from rclpy.executors import ExecutorEntity

EntityT = TypeVar("EntityT")

_WAITED_FOR = (Timer, Subscription, GuardCondition, Client, Service, Waitable)


class EntityRegistry:
    """The entities of one node.

    Attributes:
        default_group: The callback group of entities created without a group.
        is_destroyed: Whether the node was destroyed.
        waitables: The entities that an executor waits for. Executors read the tuple without a lock.
    """

    def __init__(self, node_name: str, logger_name: str, context: Context) -> None:
        self._node_name = node_name
        self._logger_name = logger_name
        self._context = context
        self._lock = threading.RLock()
        self._entities: dict[type[Any], list[Any]] = {kind: [] for kind in (*_WAITED_FOR, Publisher, Rate)}
        self.default_group: CallbackGroup = MutuallyExclusiveCallbackGroup()
        self.is_destroyed = False
        self.waitables: tuple[ExecutorEntity, ...] = ()

    def of(self, kind: type[EntityT]) -> list[EntityT]:
        """Return the entities of a kind."""
        return self._entities[kind]

    def all(self) -> list[Any]:
        """Return all entities."""
        with self._lock:
            return [entity for entities in self._entities.values() for entity in entities]

    def check_not_destroyed(self) -> None:
        """Raise an error if the node was destroyed."""
        if self.is_destroyed:
            raise destroyed_error(f"The node {self._node_name}")

    def check_usable(self, entity: str) -> None:
        """Check that an entity can be created: the node exists, and its context was not shut down."""
        self.check_not_destroyed()
        # After a signal, a program may still create publishers for final messages.
        if not (self._context.ok() or self._context._Coframe__was_shut_down_by_signal):
            reason = "Failed to create {}: rcl node's context is invalid"
            if entity in {"timer", "guard_condition"}:
                reason = (
                    "failed to create {}: the given context is not valid, either rcl_init() was not called or "
                    "rcl_shutdown() was called."
                )
            hint = "rclpy.shutdown() was called. Create a new node after rclpy.init()."
            raise _with_hint(RCLError(reason.format(entity)), hint)

    def group(self, group: CallbackGroup | None) -> CallbackGroup:
        """Return the callback group of an entity."""
        return self.default_group if group is None else group

    def add(self, entity: EntityT) -> EntityT:
        """Add an entity, so that the node lists and destroys it, and return it."""
        with self._lock:
            self._like(entity).append(entity)
            self._collect_waitables()
        if isinstance(entity, LoggingEntity):
            entity._Coframe__logger_name = self._logger_name
        group = getattr(entity, "callback_group", None)
        if group is not None:
            group.add_entity(entity)
        self._context._Coframe__wakeup.set()
        return entity

    def add_with_events(self, entity: EntityT, handlers: list[EventHandler], reporter: MismatchReporter) -> EntityT:
        """Add an entity with the handlers of its QoS events, and return it."""
        reporter.handlers = handlers
        for handler in handlers:
            self.add_waitable(handler)
        return self.add(entity)

    def add_waitable(self, waitable: Waitable) -> None:
        """Add a waitable, which may belong to no callback group."""
        self.check_not_destroyed()
        with self._lock:
            self._entities[Waitable].append(waitable)
            self._collect_waitables()
        self._context._Coframe__wakeup.set()

    def remove_waitable(self, waitable: Waitable) -> None:
        """Remove a waitable without destroying it.

        Raises:
            ValueError: The waitable was not added.
        """
        with self._lock:
            self._entities[Waitable].remove(waitable)
            self._collect_waitables()

    def remove(self, entity: Any) -> bool:
        """Remove and destroy an entity. Return False if it does not belong to this node."""
        with self._lock:
            entities = self._like(entity)
            if entity not in entities:
                return False
            entities.remove(entity)
            for handler in getattr(entity, "event_handlers", ()):
                self._entities[Waitable].remove(handler)
            self._collect_waitables()
        entity.destroy()
        return True

    def begin_destruction(self) -> bool:
        """Accept no more entities. Return False if the node was destroyed before."""
        with self._lock:
            was_destroyed, self.is_destroyed = self.is_destroyed, True
        return not was_destroyed

    def destroy_all(self) -> None:
        """Destroy all entities except the waitables, which the user destroys."""
        self._entities[Waitable].clear()
        for entities in self._entities.values():
            while entities:
                entities.pop().destroy()
        self.waitables = ()

    def _like(self, entity: Any) -> list[Any]:
        return next((entities for kind, entities in self._entities.items() if isinstance(entity, kind)), [])

    def _collect_waitables(self) -> None:
        self.waitables = tuple(entity for kind in _WAITED_FOR for entity in self._entities[kind])


def check_callback(callback: object) -> None:
    """Raise a TypeError if a callback is not callable."""
    if not callable(callback):
        raise TypeError(f"The callback must be a function, not {callback!r}. Pass the function without calling it.")
