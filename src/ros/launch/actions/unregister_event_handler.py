# SPDX-License-Identifier: Apache-2.0
"""The action that unregisters an event handler."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action

if TYPE_CHECKING:
    from launch.event_handler import BaseEventHandler
    from launch.launch_context import LaunchContext

__all__ = ["UnregisterEventHandler"]


class UnregisterEventHandler(Action):
    """Unregister an event handler."""

    def __init__(self, event_handler: BaseEventHandler, **options: Any) -> None:
        super().__init__(**options)
        self.__event_handler = event_handler

    @property
    def event_handler(self) -> BaseEventHandler:
        """The event handler."""
        return self.__event_handler

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Unregister the handler."""
        context.unregister_event_handler(self.__event_handler)
        return None
