# SPDX-License-Identifier: Apache-2.0
"""Base class of handlers for the events of one action."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.event_handler import BaseEventHandler
from launch.utilities import normalize_to_list_of_entities

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_entities_type import SomeEntitiesType

__all__ = ["OnActionEventBase"]


class OnActionEventBase(BaseEventHandler):
    """A handler for events of an action.

    Args:
        action_matcher: The action, a predicate for actions, or None for all actions.
        on_event: Entities, or a function from the event and the context to entities.
        target_event_cls: Class of the events.
        target_action_cls: Class of the actions.
        options: Keyword arguments of BaseEventHandler.
    """

    def __init__(
        self,
        *,
        action_matcher: Callable[[Any], bool] | Action | None,
        on_event: SomeEntitiesType | Callable[[Any, LaunchContext], SomeEntitiesType | None],
        target_event_cls: type[Event],
        target_action_cls: type[Action],
        **options: Any,
    ) -> None:
        # An action of another class can only be a mistake.
        is_action = isinstance(action_matcher, Action)
        if action_matcher is not None and not (
            isinstance(action_matcher, target_action_cls) if is_action else callable(action_matcher)
        ):
            raise TypeError(f"action_matcher must be an '{target_action_cls.__name__}' instance or a callable")
        self.__target_event_cls = target_event_cls
        self.__action_matcher = action_matcher

        def matches(event: Event) -> bool:
            if not isinstance(event, target_event_cls):
                return False
            action = event.action  # type: ignore[attr-defined]
            if action_matcher is None or action is action_matcher:
                return True
            return not isinstance(action_matcher, Action) and action_matcher(action)

        super().__init__(matcher=matches, **options)
        self.__on_event = on_event if callable(on_event) else None
        self.__entities = [] if callable(on_event) else normalize_to_list_of_entities(on_event)

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the entities for the event."""
        super().handle(event, context)
        return self.__entities if self.__on_event is None else self.__on_event(event, context)

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description and the entities of the handler."""
        return super().describe()[0], self.__entities

    @property
    def handler_description(self) -> str:
        """A description of the handler's actions."""
        return "<actions>" if self.__on_event is None else f"{self.__on_event}"

    @property
    def matcher_description(self) -> str:
        """A description of the matching events."""
        action = self.__action_matcher
        target = "any action" if action is None else f"{action}"
        return f"event == {self.__target_event_cls.__name__} and event.action == {target}"
