# SPDX-License-Identifier: Apache-2.0
"""The substitution of a launch configuration."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from coframe._output.formatting import did_you_mean
from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["LaunchConfiguration"]


@expose_substitution("var")
class LaunchConfiguration(Substitution):
    """The value of a launch configuration, such as an argument of the launch file.

    Args:
        variable_name: The name of the launch configuration.
        default: The value if it is not set.
    """

    def __init__(self, variable_name: SomeSubstitutionsType, *, default: Any = None) -> None:
        self.__variable_name = normalize_to_list_of_substitutions(variable_name)
        self.__default = None
        if default is not None:
            is_text = isinstance(default, str | Substitution | Iterable)
            self.__default = normalize_to_list_of_substitutions(default if is_text else str(default))

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(var NAME [DEFAULT])``."""
        check_arguments("var", data, 1, 2)
        return cls, {"variable_name": data[0]} | ({"default": data[1]} if len(data) == 2 else {})

    @property
    def variable_name(self) -> list[Substitution]:
        """The name."""
        return self.__variable_name

    def describe(self) -> str:
        """Return a one-line description."""
        return f"LaunchConfig({' + '.join(part.describe() for part in self.variable_name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value."""
        name = perform_substitutions(context, self.__variable_name)
        if name in context.launch_configurations:
            value: str = context.launch_configurations[name]
            return value
        if self.__default is not None:
            return perform_substitutions(context, self.__default)
        guess = did_you_mean(name, context.launch_configurations, limit=2)
        raise SubstitutionFailure(f"launch configuration '{name}' does not exist" + (f". {guess}" if guess else ""))
