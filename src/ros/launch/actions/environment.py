# SPDX-License-Identifier: Apache-2.0
"""The actions that set and unset environment variables, and that save and restore all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.actions._named import NamedAction, NamedValueAction
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Mapping

    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = [
    "PopEnvironment",
    "PushEnvironment",
    "ReplaceEnvironmentVariables",
    "ResetEnvironment",
    "SetEnvironmentVariable",
    "UnsetEnvironmentVariable",
]


@expose_action("set_env")
class SetEnvironmentVariable(NamedValueAction):
    """Set an environment variable."""

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the variable."""
        name = perform_substitutions(context, self.name)
        context.environment[name] = perform_substitutions(context, self.value)
        return None


@expose_action("unset_env")
class UnsetEnvironmentVariable(NamedAction):
    """Unset an environment variable, if it is set."""

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Unset the variable."""
        context.environment.pop(perform_substitutions(context, self.name), None)
        return None


class PushEnvironment(Action):
    """Save all environment variables, for PopEnvironment."""

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Save the variables."""
        context._push_environment()  # noqa: SLF001
        return None


class PopEnvironment(Action):
    """Restore the environment variables that PushEnvironment has saved."""

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Restore the variables."""
        context._pop_environment()  # noqa: SLF001
        return None


@expose_action("reset_env")
class ResetEnvironment(Action):
    """Restore the environment variables that the program was started with."""

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<reset_env>``."""
        return cls, super().parse(entity, parser)[1]

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Restore the variables."""
        context._reset_environment()  # noqa: SLF001
        return None


@expose_action("replace_env")
class ReplaceEnvironmentVariables(Action):
    """Replace all environment variables.

    Args:
        environment: The variables with their values, or None for no variables.
        condition: Replace them only if this condition holds.
    """

    def __init__(
        self, environment: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None, **options: Any
    ) -> None:
        super().__init__(**options)
        self.__environment = [
            (normalize_to_list_of_substitutions(name), normalize_to_list_of_substitutions(value))
            for name, value in (environment or {}).items()
        ]

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<replace_env>`` with its ``<env name=... value=...>``."""
        _, options = super().parse(entity, parser)
        pairs = {}
        for each in entity.get_attr("env", data_type=list, optional=True) or ():
            name = tuple(parser.parse_substitution(each.get_attr("name")))
            pairs[name] = parser.parse_substitution(each.get_attr("value"))
            each.assert_entity_completely_parsed()
        return cls, options | {"environment": pairs}

    @property
    def environment(self) -> list[tuple[list[Substitution], list[Substitution]]]:
        """The variables with their values."""
        return self.__environment

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Replace the variables."""
        context._replace_environment(  # noqa: SLF001
            {
                perform_substitutions(context, name): perform_substitutions(context, value)
                for name, value in self.__environment
            }
        )
        return None
