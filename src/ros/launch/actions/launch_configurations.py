# SPDX-License-Identifier: Apache-2.0
"""The actions that set and unset launch configurations, and that save and restore all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = [
    "PopLaunchConfigurations",
    "PushLaunchConfigurations",
    "ResetLaunchConfigurations",
    "SetLaunchConfiguration",
    "UnsetLaunchConfiguration",
]


@expose_action("let")
class SetLaunchConfiguration(Action):
    """Set a launch configuration."""

    def __init__(self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<let name=... value=...>``."""
        _, options = super().parse(entity, parser)
        options["name"] = parser.parse_substitution(entity.get_attr("name"))
        options["value"] = parser.parse_substitution(entity.get_attr("value"))
        return cls, options

    @property
    def name(self) -> list[Substitution]:
        """The name of the launch configuration."""
        return self.__name

    @property
    def value(self) -> list[Substitution]:
        """The value."""
        return self.__value

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the launch configuration."""
        name = perform_substitutions(context, self.__name)
        context.launch_configurations[name] = perform_substitutions(context, self.__value)
        return None


@expose_action("unset")
class UnsetLaunchConfiguration(Action):
    """Unset a launch configuration, if it is set."""

    def __init__(self, name: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<unset name=...>``."""
        _, options = super().parse(entity, parser)
        return cls, options | {"name": parser.parse_substitution(entity.get_attr("name"))}

    @property
    def name(self) -> list[Substitution]:
        """The name of the launch configuration."""
        return self.__name

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Unset the launch configuration."""
        context.launch_configurations.pop(perform_substitutions(context, self.__name), None)
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
        launch_configurations: Names and values of those that stay; None for none of them.
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
