# SPDX-License-Identifier: Apache-2.0
"""The substitution that joins strings with a delimiter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["StringJoinSubstitution"]

_MIN_ARGUMENTS = 2


@expose_substitution("string-join")
class StringJoinSubstitution(Substitution):
    """Strings joined by a delimiter."""

    def __init__(self, substitutions: Iterable[SomeSubstitutionsType], delimiter: SomeSubstitutionsType = "") -> None:
        self.__substitutions = [normalize_to_list_of_substitutions(part) for part in substitutions]
        self.__delimiter = normalize_to_list_of_substitutions(delimiter)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(string-join DELIMITER PART...)``."""
        if len(data) < _MIN_ARGUMENTS:
            raise TypeError("string-join substitution expects at least 2 arguments: 1 delimiter + at least 1 component")
        return cls, {"delimiter": data[0], "substitutions": data[1:]}

    @property
    def substitutions(self) -> list[list[Substitution]]:
        """The strings."""
        return self.__substitutions

    @property
    def delimiter(self) -> list[Substitution]:
        """The delimiter."""
        return self.__delimiter

    def describe(self) -> str:
        """Return a one-line description."""
        parts = (" + ".join(each.describe() for each in part) for part in self.__substitutions)
        return f"StringJoin({', '.join(parts)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the string."""
        parts = [perform_substitutions(context, part) for part in self.__substitutions]
        return perform_substitutions(context, self.__delimiter).join(parts)
