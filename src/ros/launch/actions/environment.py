# SPDX-License-Identifier: Apache-2.0
"""The actions that set and unset environment variables, and that save and restore all of them."""

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
    "PopEnvironment",
    "PushEnvironment",
    "ResetEnvironment",
    "SetEnvironmentVariable",
    "UnsetEnvironmentVariable",
]


@expose_action("set_env")
class SetEnvironmentVariable(Action):
    """Set an environment variable."""

    def __init__(self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<set_env name=... value=...>``."""
        _, options = super().parse(entity, parser)
        options["name"] = parser.parse_substitution(entity.get_attr("name"))
        options["value"] = parser.parse_substitution(entity.get_attr("value"))
        return cls, options

    @property
    def name(self) -> list[Substitution]:
        """The name of the variable."""
        return self.__name

    @property
    def value(self) -> list[Substitution]:
        """The value."""
        return self.__value

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the variable."""
        name = perform_substitutions(context, self.__name)
        context.environment[name] = perform_substitutions(context, self.__value)
        return None


@expose_action("unset_env")
class UnsetEnvironmentVariable(Action):
    """Unset an environment variable, if it is set."""

    def __init__(self, name: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<unset_env name=...>``."""
        _, options = super().parse(entity, parser)
        return cls, options | {"name": parser.parse_substitution(entity.get_attr("name"))}

    @property
    def name(self) -> list[Substitution]:
        """The name of the variable."""
        return self.__name

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Unset the variable."""
        context.environment.pop(perform_substitutions(context, self.__name), None)
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
