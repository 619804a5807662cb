# SPDX-License-Identifier: Apache-2.0
"""The handler that visits launch descriptions which are included by an event."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handler import BaseEventHandler
from launch.events.include_launch_description import IncludeLaunchDescription
from launch.utilities import is_a

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType

__all__ = ["OnIncludeLaunchDescription"]


class OnIncludeLaunchDescription(BaseEventHandler):
    """A handler that visits the launch description of an event."""

    def __init__(self, **options: Any) -> None:
        super().__init__(matcher=lambda event: is_a(event, IncludeLaunchDescription), **options)

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the launch description."""
        super().handle(event, context)
        assert isinstance(event, IncludeLaunchDescription)
        return event.launch_description
