# SPDX-License-Identifier: Apache-2.0
"""The handler for the shutdown of the system."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handler import BaseEventHandler
from launch.events.shutdown import Shutdown
from launch.utilities import is_a, normalize_to_list_of_entities

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_entities_type import SomeEntitiesType

__all__ = ["OnShutdown"]


class OnShutdown(BaseEventHandler):
    """A handler for the shutdown of the system.

    Args:
        on_shutdown: Entities, or a function from the event and the context to entities.
        options: Keyword arguments of BaseEventHandler.
    """

    def __init__(
        self,
        *,
        on_shutdown: SomeEntitiesType | Callable[[Shutdown, LaunchContext], SomeEntitiesType | None],
        **options: Any,
    ) -> None:
        super().__init__(matcher=lambda event: is_a(event, Shutdown), **options)
        self.__function = on_shutdown if callable(on_shutdown) else None
        self.__entities = [] if callable(on_shutdown) else normalize_to_list_of_entities(on_shutdown)

    @property
    def matcher_description(self) -> str:
        """A description of the matching events."""
        return "event issubclass of launch.events.Shutdown"

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description and the entities of the handler."""
        return super().describe()[0], self.__entities

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the entities for the shutdown."""
        super().handle(event, context)
        assert isinstance(event, Shutdown)
        return self.__entities if self.__function is None else self.__function(event, context)
