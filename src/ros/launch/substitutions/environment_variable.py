# SPDX-License-Identifier: Apache-2.0
"""The substitution of an environment variable."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["EnvironmentVariable"]


@expose_substitution("env")
class EnvironmentVariable(Substitution):
    """The value of an environment variable.

    Args:
        name: The name of the environment variable.
        default_value: The value if it is not set.
    """

    def __init__(self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None) -> None:
        self.__name = normalize_to_list_of_substitutions(name)
        self.__default_value = None if default_value is None else normalize_to_list_of_substitutions(default_value)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(env NAME [DEFAULT])``."""
        check_arguments("env", data, 1, 2)
        return cls, {"name": data[0]} | ({"default_value": data[1]} if len(data) == 2 else {})

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    @property
    def default_value(self) -> list[Substitution] | None:
        """The value if the variable is not set."""
        return self.__default_value

    def describe(self) -> str:
        """Return a one-line description."""
        return f"EnvVar({' + '.join(part.describe() for part in self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value."""
        name = perform_substitutions(context, self.__name)
        if name in context.environment:
            return context.environment[name]
        if self.__default_value is None:
            raise SubstitutionFailure(f"environment variable '{name}' does not exist")
        return perform_substitutions(context, self.__default_value)
