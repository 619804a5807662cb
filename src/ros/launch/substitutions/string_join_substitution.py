# SPDX-License-Identifier: Apache-2.0
"""The substitution that joins strings with a delimiter."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Iterable

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["StringJoinSubstitution"]


class StringJoinSubstitution(Substitution):
    """Strings joined by a delimiter."""

    def __init__(self, substitutions: Iterable[SomeSubstitutionsType], delimiter: SomeSubstitutionsType = "") -> None:
        self.__substitutions = [normalize_to_list_of_substitutions(part) for part in substitutions]
        self.__delimiter = normalize_to_list_of_substitutions(delimiter)

    def describe(self) -> str:
        """Return a one-line description."""
        parts = (" + ".join(each.describe() for each in part) for part in self.__substitutions)
        return f"StringJoin({', '.join(parts)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        parts = [perform_substitutions(context, part) for part in self.__substitutions]
        return perform_substitutions(context, self.__delimiter).join(parts)
