# SPDX-License-Identifier: Apache-2.0
"""The action that emits an event."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext

__all__ = ["EmitEvent"]


class EmitEvent(Action):
    """Emit an event."""

    def __init__(self, *, event: Event, **options: Any) -> None:
        super().__init__(**options)
        self.__event = event

    @property
    def event(self) -> Event:
        """The event."""
        return self.__event

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Emit the event."""
        context.emit_event_sync(self.__event)
        return None
