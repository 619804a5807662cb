# SPDX-License-Identifier: Apache-2.0
"""The substitution of a parameter that SetParameter has set."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["Parameter"]


@expose_substitution("param")
class Parameter(Substitution):
    """The value of a parameter that SetParameter has set for all nodes.

    Args:
        name: The name of the parameter.
        default: The value if it is not set.
    """

    def __init__(self, name: SomeSubstitutionsType, *, default: Any = None) -> None:
        self.__name = normalize_to_list_of_substitutions(name)
        self.__default = None
        if default is not None:
            is_text = isinstance(default, str | Substitution | list | tuple)
            self.__default = normalize_to_list_of_substitutions(default if is_text else str(default))

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(param NAME [DEFAULT])``."""
        check_arguments("param", data, 1, 2)
        return cls, {"name": data[0]} | ({"default": data[1]} if len(data) == 2 else {})

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    def describe(self) -> str:
        """Return a one-line description."""
        return f"Parameter(name={' + '.join(part.describe() for part in self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value as a string."""
        name = perform_substitutions(context, self.__name)
        for each in reversed(context.launch_configurations.get("global_params", [])):
            if isinstance(each, tuple) and each[0] == name:
                return str(each[1])
        if self.__default is not None:
            return perform_substitutions(context, self.__default)
        raise SubstitutionFailure(f"parameter '{name}' not found")
