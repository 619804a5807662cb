# SPDX-License-Identifier: Apache-2.0
"""The action that groups actions, with their own launch configurations and environment."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.actions.environment import PopEnvironment, PushEnvironment, ResetEnvironment
from launch.actions.launch_configurations import (
    PopLaunchConfigurations,
    PushLaunchConfigurations,
    ResetLaunchConfigurations,
    SetLaunchConfiguration,
)
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from collections.abc import Iterable

    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["GroupAction"]


@expose_action("group")
class GroupAction(Action):
    """Visit actions in their own scope, by default.

    Args:
        actions: The actions to visit, in this order.
        scoped: Undo changes of launch configurations and of the environment after the group.
        forwarding: Keep the launch configurations and the environment from outside in a scope.
        launch_configurations: Launch configurations to set in the scope.
        condition: Visit the group only if this condition holds.
    """

    def __init__(
        self,
        actions: Iterable[Action],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: dict[Any, SomeSubstitutionsType] | None = None,
        **options: Any,
    ) -> None:
        super().__init__(**options)
        self.__actions = list(actions)
        self.__scoped = scoped
        self.__forwarding = forwarding
        self.__launch_configurations = dict(launch_configurations or {})
        self.__actions_to_return: list[LaunchDescriptionEntity] | None = None

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<group scoped=... forwarding=...>`` with its actions; ``<keep>`` sets launch configurations."""
        _, options = super().parse(entity, parser)
        for name in ("scoped", "forwarding"):
            value = entity.get_attr(name, data_type=bool, optional=True)
            if value is not None:
                options[name] = value
        kept = entity.get_attr("keep", data_type=list, optional=True)
        if kept is not None:
            options["launch_configurations"] = {
                tuple(parser.parse_substitution(keep.get_attr("name"))): parser.parse_substitution(
                    keep.get_attr("value")
                )
                for keep in kept
            }
        options["actions"] = [parser.parse_action(child) for child in entity.children if child.type_name != "keep"]
        return cls, options

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the actions, between those that open and close the scope."""
        if self.__actions_to_return is None:
            pairs = self.__launch_configurations.items()
            configurations: list[LaunchDescriptionEntity] = [
                SetLaunchConfiguration(list(name) if isinstance(name, tuple) else name, value) for name, value in pairs
            ]
            if not self.__scoped:
                self.__actions_to_return = [*configurations, *self.__actions]
            else:
                # Values for a scope without forwarding are computed outside of it.
                opening: list[LaunchDescriptionEntity] = (
                    configurations
                    if self.__forwarding
                    else [ResetEnvironment(), ResetLaunchConfigurations(self.__launch_configurations)]
                )
                self.__actions_to_return = [
                    PushLaunchConfigurations(),
                    PushEnvironment(),
                    *opening,
                    *self.__actions,
                    PopEnvironment(),
                    PopLaunchConfigurations(),
                ]
        return self.__actions_to_return

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Return the actions."""
        del context
        return self.get_sub_entities()
