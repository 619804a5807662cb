# SPDX-License-Identifier: Apache-2.0
"""The actions that set and unset environment variables, and that save and restore all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.actions._named import NamedAction, NamedValueAction
from launch.frontend.expose import expose_action
from launch.utilities import perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext

__all__ = [
    "PopEnvironment",
    "PushEnvironment",
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
