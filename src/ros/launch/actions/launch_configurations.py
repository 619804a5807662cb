# SPDX-License-Identifier: Apache-2.0
"""The actions that set and unset launch configurations, and that save and restore all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.actions._named import NamedAction, NamedValueAction
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = [
    "PopLaunchConfigurations",
    "PushLaunchConfigurations",
    "ResetLaunchConfigurations",
    "SetLaunchConfiguration",
    "UnsetLaunchConfiguration",
]


@expose_action("let")
class SetLaunchConfiguration(NamedValueAction):
    """Set a launch configuration."""

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the launch configuration."""
        name = perform_substitutions(context, self.name)
        context.launch_configurations[name] = perform_substitutions(context, self.value)
        return None


@expose_action("unset")
class UnsetLaunchConfiguration(NamedAction):
    """Unset a launch configuration, if it is set."""

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Unset the launch configuration."""
        context.launch_configurations.pop(perform_substitutions(context, self.name), None)
        return None


class PushLaunchConfigurations(Action):
    """Save all launch configurations, for PopLaunchConfigurations."""

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Save the launch configurations."""
        context._push_launch_configurations()  # noqa: SLF001
        return None


class PopLaunchConfigurations(Action):
    """Restore the launch configurations that PushLaunchConfigurations has saved."""

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Restore the launch configurations."""
        context._pop_launch_configurations()  # noqa: SLF001
        return None


@expose_action("reset")
class ResetLaunchConfigurations(Action):
    """Remove all launch configurations except the given ones.

    Args:
        launch_configurations: Names and values of those that stay, or None for none of them.
        condition: Do it only if this condition holds.
    """

    def __init__(
        self,
        launch_configurations: dict[Any, SomeSubstitutionsType] | None = None,
        **options: Any,
    ) -> None:
        super().__init__(**options)
        self.__launch_configurations = dict(launch_configurations or {})

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<reset>`` with ``<keep name=... value=...>``."""
        _, options = super().parse(entity, parser)
        kept = {}
        for keep in entity.get_attr("keep", data_type=list, optional=True) or []:
            name = tuple(parser.parse_substitution(keep.get_attr("name")))
            kept[name] = parser.parse_substitution(keep.get_attr("value"))
            keep.assert_entity_completely_parsed()
        return cls, options | {"launch_configurations": kept}

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Remove the launch configurations."""
        kept = {
            perform_substitutions(context, normalize_to_list_of_substitutions(name)): perform_substitutions(
                context, normalize_to_list_of_substitutions(value)
            )
            for name, value in self.__launch_configurations.items()
        }
        context.launch_configurations.clear()
        context.launch_configurations.update(kept)
        return None
