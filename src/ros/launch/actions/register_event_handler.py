# SPDX-License-Identifier: Apache-2.0
"""The action that registers an event handler."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action

if TYPE_CHECKING:
    from launch.event_handler import BaseEventHandler
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity

__all__ = ["RegisterEventHandler"]


class RegisterEventHandler(Action):
    """Register an event handler."""

    def __init__(self, event_handler: BaseEventHandler, **options: Any) -> None:
        super().__init__(**options)
        self.__event_handler = event_handler

    @property
    def event_handler(self) -> BaseEventHandler:
        """The event handler."""
        return self.__event_handler

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Register the handler."""
        context.register_event_handler(self.__event_handler)
        return None

    def describe_conditional_sub_entities(self) -> list[tuple[str, list[LaunchDescriptionEntity]]]:
        """Return the entities of the handler."""
        text, entities = self.__event_handler.describe()
        return [(text, list(entities))] if entities else []
