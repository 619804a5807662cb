# SPDX-License-Identifier: Apache-2.0
"""Base class of actions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext

__all__ = ["Action"]


class Action(LaunchDescriptionEntity):
    """An entity that does something when it is executed.

    Args:
        condition: Execute the action only if this condition holds.
    """

    def __init__(self, *, condition: Condition | None = None) -> None:
        self.__condition = condition

    @staticmethod
    def parse(entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read the attributes `if` and `unless`, and return the class and its keyword arguments."""
        from launch.conditions import IfCondition, UnlessCondition  # noqa: PLC0415 - these classes need actions

        condition = entity.get_attr("if", optional=True)
        exclusion = entity.get_attr("unless", optional=True)
        if condition is not None and exclusion is not None:
            raise RuntimeError("if and unless conditions can't be used simultaneously")
        if condition is not None:
            return Action, {"condition": IfCondition(parser.parse_substitution(condition))}
        if exclusion is not None:
            return Action, {"condition": UnlessCondition(parser.parse_substitution(exclusion))}
        return Action, {}

    @property
    def condition(self) -> Condition | None:
        """The condition of the action."""
        return self.__condition

    def describe(self) -> str:
        """Return a one-line description."""
        return self.__repr__()

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities that this action contains. Subclasses override it."""
        return []

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities that are always visited after this one."""
        return self.get_sub_entities() if self.condition is None else []

    def describe_conditional_sub_entities(self) -> list[tuple[str, list[LaunchDescriptionEntity]]]:
        """Return the entities that are visited only if the condition holds."""
        return [("Conditionally included by " + self.describe(), self.get_sub_entities())] if self.condition else []

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Execute the action if its condition holds, and emit ExecutionComplete when it has finished."""
        from launch.events import ExecutionComplete  # noqa: PLC0415 - events need actions

        if self.__condition is not None and not self.__condition.evaluate(context):
            return None
        try:
            return self.execute(context)
        finally:
            event = ExecutionComplete(action=self)
            if context.would_handle_event(event):
                future = self.get_asyncio_future()
                if future is None:
                    context.emit_event_sync(event)
                else:
                    future.add_done_callback(lambda _: context.emit_event_sync(event))

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Do the work of the action and return the entities to visit next. Subclasses override it."""
        del context
        return None
