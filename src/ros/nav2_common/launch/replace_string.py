# SPDX-License-Identifier: Apache-2.0
"""The substitution of a copy of a file with other strings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._files.regular_files import read_regular_text
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.temporary_files import write_temporary_file

if TYPE_CHECKING:
    from collections.abc import Mapping

    from launch.condition import Condition
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["ReplaceString"]

_MAX_BYTES = 64 << 20  # of the file


class ReplaceString(Substitution):
    """The path of a copy of a file in which strings are replaced.

    Args:
        source_file: The path of the file to copy.
        replacements: The new strings by the old ones.
        condition: Replace them only if this condition holds; else the path is that of the file.
    """

    def __init__(
        self,
        source_file: SomeSubstitutionsType,
        replacements: Mapping[str, SomeSubstitutionsType],
        condition: Condition | None = None,
    ) -> None:
        self.__source_file = normalize_to_list_of_substitutions(source_file)
        self.__replacements = {old: normalize_to_list_of_substitutions(new) for old, new in replacements.items()}
        self.__condition = condition

    @property
    def condition(self) -> Condition | None:
        """The condition."""
        return self.__condition

    def describe(self) -> str:
        """Return nothing, as upstream."""
        return ""

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        path = perform_substitutions(context, self.__source_file)
        if self.__condition is not None and not self.__condition.evaluate(context):
            return path
        text = read_regular_text(path, _MAX_BYTES)
        for old, new in self.__replacements.items():
            text = text.replace(old, perform_substitutions(context, new))
        return str(write_temporary_file(text))
