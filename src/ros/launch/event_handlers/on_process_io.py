# SPDX-License-Identifier: Apache-2.0
"""The handler for the output of a process."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.process import ProcessIO

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.action import Action
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType

__all__ = ["OnProcessIO"]


class OnProcessIO(OnActionEventBase):
    """A handler for the output of a process.

    Args:
        target_action: The action, a predicate for actions, or None for all actions.
        on_stdin: Function that is called with the event of an input.
        on_stdout: Function that is called with the event of a text on standard output.
        on_stderr: Function that is called with the event of a text on standard error.
        options: Keyword arguments of BaseEventHandler.
    """

    def __init__(
        self,
        *,
        target_action: Callable[[Any], bool] | Action | None = None,
        on_stdin: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        on_stdout: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        on_stderr: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        **options: Any,
    ) -> None:
        from launch.actions.execute_local import ExecuteLocal  # noqa: PLC0415 - actions need event handlers

        def handle(event: ProcessIO, _: LaunchContext) -> SomeEntitiesType | None:
            callback = (on_stdin, on_stdout, on_stderr)[event.fd]
            return None if callback is None else callback(event)

        super().__init__(
            action_matcher=target_action,
            on_event=handle,
            target_event_cls=ProcessIO,
            target_action_cls=ExecuteLocal,
            **options,
        )
