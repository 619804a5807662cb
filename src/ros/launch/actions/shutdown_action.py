# SPDX-License-Identifier: Apache-2.0
"""The action that shuts the system down."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import launch.logging
from launch.actions.emit_event import EmitEvent
from launch.events import Shutdown as ShutdownEvent
from launch.events.process import ProcessExited
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.action import Action
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext

__all__ = ["Shutdown"]


@expose_action("shutdown")
class Shutdown(EmitEvent):
    """Shut the system down.

    Args:
        reason: Why.
        due_to_sigint: Whether Ctrl-C was pressed.
        condition: Shut down only if this condition holds.
    """

    def __init__(self, *, reason: str = "reason not given", due_to_sigint: bool = False, **options: Any) -> None:
        super().__init__(event=ShutdownEvent(reason=reason, due_to_sigint=due_to_sigint), **options)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<shutdown reason=...>``."""
        _, options = super().parse(entity, parser)
        reason = entity.get_attr("reason", optional=True)
        return cls, options | ({} if reason is None else {"reason": reason})

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Emit the event; name the process that was required, if its end is the cause."""
        event = context.get_locals_as_dict().get("event")
        if isinstance(event, ProcessExited):
            text = f"process[{event.process_name}] was required: shutting down launched system"
            launch.logging.get_logger("launch").info(text)
        return super().execute(context)
