# SPDX-License-Identifier: Apache-2.0
"""The handler for the start of a process."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.process import ProcessStarted

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.action import Action
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType

__all__ = ["OnProcessStart"]


class OnProcessStart(OnActionEventBase):
    """A handler for the start of a process.

    Args:
        target_action: The action, a predicate for actions, or None for all actions.
        on_start: Entities, or a function from the event and the context to entities.
        options: Keyword arguments of BaseEventHandler.
    """

    def __init__(
        self,
        *,
        target_action: Callable[[Any], bool] | Action | None = None,
        on_start: SomeEntitiesType | Callable[[Any, LaunchContext], SomeEntitiesType | None],
        **options: Any,
    ) -> None:
        from launch.actions.execute_local import ExecuteLocal  # noqa: PLC0415 - actions need event handlers

        super().__init__(
            action_matcher=target_action,
            on_event=on_start,
            target_event_cls=ProcessStarted,
            target_action_cls=ExecuteLocal,
            **options,
        )
