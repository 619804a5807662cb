# SPDX-License-Identifier: Apache-2.0
"""Base classes of event handlers: a matcher for events, and the entities to visit when it matches."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.utilities import normalize_to_list_of_entities

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_entities_type import SomeEntitiesType

__all__ = ["BaseEventHandler", "EventHandler"]


class BaseEventHandler:
    """A handler that is called for every event which its matcher accepts.

    Args:
        matcher: Predicate for events.
        handle_once: Unregister the handler after its first event.
    """

    def __init__(self, *, matcher: Callable[[Event], bool], handle_once: bool = False) -> None:
        self.__matcher = matcher
        self.__handle_once = handle_once

    @property
    def handle_once(self) -> bool:
        """Whether the handler is unregistered after its first event."""
        return self.__handle_once

    @property
    def handler_description(self) -> str:
        """A description of the handler's actions."""
        return "<actions>"

    @property
    def matcher_description(self) -> str:
        """A description of the matching events."""
        return "<matcher>"

    def matches(self, event: Event) -> bool:
        """Return whether the event is for this handler."""
        return self.__matcher(event)

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description and the entities of the handler."""
        text = f"{type(self).__name__}(matcher='{self.matcher_description}', handler='{self.handler_description}', "
        return f"{text}handle_once={self.handle_once})", []

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        """Handle the event and return the entities to visit."""
        context.extend_locals({"event": event})
        if self.handle_once:
            context.unregister_event_handler(self)
        return None


class EventHandler(BaseEventHandler):
    """A handler that returns fixed entities.

    Args:
        matcher: Predicate for events.
        entities: Entities to visit when an event matches.
        handle_once: Unregister the handler after its first event.
    """

    def __init__(
        self,
        *,
        matcher: Callable[[Event], bool],
        entities: SomeEntitiesType | None = None,
        handle_once: bool = False,
    ) -> None:
        super().__init__(matcher=matcher, handle_once=handle_once)
        self.__entities = normalize_to_list_of_entities(entities)

    @property
    def entities(self) -> list[LaunchDescriptionEntity]:
        """The entities to visit when an event matches."""
        return self.__entities

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description and the entities of the handler."""
        return super().describe()[0], self.entities

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the entities."""
        super().handle(event, context)
        return self.entities
