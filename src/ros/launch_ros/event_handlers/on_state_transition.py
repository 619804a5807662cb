# SPDX-License-Identifier: Apache-2.0
"""The handler for a change of state of a lifecycle node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handler import EventHandler
from launch_ros.events.lifecycle import StateTransition

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.event import Event
    from launch.some_entities_type import SomeEntitiesType
    from launch_ros.actions.lifecycle_node import LifecycleNode

__all__ = ["OnStateTransition"]


class OnStateTransition(EventHandler):
    """A handler for a change of state of a lifecycle node.

    Args:
        entities: Entities to visit.
        target_lifecycle_node: The action that has started the node, or None for all nodes.
        transition: Name of the transition, or None for all.
        start_state: Name of the state before, or None for all.
        goal_state: Name of the state after, or None for all.
        matcher: Predicate for events, instead of all these.
        options: Keyword arguments of EventHandler.
    """

    def __init__(
        self,
        *,
        entities: SomeEntitiesType,
        target_lifecycle_node: LifecycleNode | None = None,
        transition: str | None = None,
        start_state: str | None = None,
        goal_state: str | None = None,
        matcher: Callable[[Event], bool] | None = None,
        **options: Any,
    ) -> None:
        def matches(event: Event) -> bool:
            if not isinstance(event, StateTransition) or target_lifecycle_node not in {None, event.action}:
                return False
            wanted = (transition, start_state, goal_state)
            found = (event.transition, event.start_state, event.goal_state)
            return all(name in {None, label} for name, label in zip(wanted, found, strict=True))

        super().__init__(matcher=matcher or matches, entities=entities, **options)
