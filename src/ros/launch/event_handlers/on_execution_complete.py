# SPDX-License-Identifier: Apache-2.0
"""The handler for the completion of an action."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.execution_complete import ExecutionComplete

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.action import Action
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType

__all__ = ["OnExecutionComplete"]


class OnExecutionComplete(OnActionEventBase):
    """A handler for the completion of an action.

    Args:
        target_action: The action, a predicate for actions, or None for all actions.
        on_completion: Entities, or a function from the event and the context to entities.
        options: Keyword arguments of BaseEventHandler.
    """

    def __init__(
        self,
        *,
        target_action: Callable[[Any], bool] | Action | None = None,
        on_completion: SomeEntitiesType | Callable[[Any, LaunchContext], SomeEntitiesType | None],
        **options: Any,
    ) -> None:
        from launch.action import Action  # noqa: PLC0415 - actions need event handlers

        super().__init__(
            action_matcher=target_action,
            on_event=on_completion,
            target_event_cls=ExecutionComplete,
            target_action_cls=Action,
            **options,
        )
