# SPDX-License-Identifier: Apache-2.0
"""The substitution of the XML of a xacro file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_param_builder import load_xacro

if TYPE_CHECKING:
    from collections.abc import Mapping

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["Xacro"]


class Xacro(Substitution):
    """The XML of a xacro file.

    Args:
        file_path: The file.
        mappings: The values of its arguments, by name.
    """

    def __init__(
        self,
        file_path: SomeSubstitutionsType,
        *,
        mappings: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
    ) -> None:
        self.__file_path = normalize_to_list_of_substitutions(file_path)
        self.__mappings = [
            (normalize_to_list_of_substitutions(name), normalize_to_list_of_substitutions(value))
            for name, value in (mappings or {}).items()
        ]

    @property
    def file_path(self) -> list[Substitution]:
        """The file."""
        return self.__file_path

    @property
    def mappings(self) -> list[tuple[list[Substitution], list[Substitution]]]:
        """The arguments and their values."""
        return self.__mappings

    def describe(self) -> str:
        """Return a description."""
        return f"Xacro(file_path = {' + '.join(part.describe() for part in self.__file_path)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the XML."""
        mappings = {
            perform_substitutions(context, name): perform_substitutions(context, value)
            for name, value in self.__mappings
        }
        return load_xacro(perform_substitutions(context, self.__file_path), mappings)
