# SPDX-License-Identifier: Apache-2.0
"""Base class of the sources of launch descriptions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from launch.substitutions import TextSubstitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description import LaunchDescription
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["LaunchDescriptionSource"]


class LaunchDescriptionSource:
    """A launch description, or the file from which it is read.

    Args:
        launch_description: The description; None to read it from `location`.
        location: The file, or a placeholder such as ``<script>``.
        method: The origin of the description, for descriptions of this object.
    """

    def __init__(
        self,
        launch_description: LaunchDescription | None = None,
        location: SomeSubstitutionsType = "<string>",
        method: str = "unspecified mechanism from a script",
    ) -> None:
        self.__launch_description = launch_description
        self.__location = normalize_to_list_of_substitutions(location)
        self.__expanded_location: str | None = None
        self.__method = method

    @property
    def location(self) -> str:
        """The file, as far as it is known."""
        if self.__expanded_location is None:
            return " + ".join(part.describe() for part in self.__location)
        return self.__expanded_location

    @property
    def method(self) -> str:
        """The origin of the description."""
        return self.__method

    def try_get_launch_description_without_context(self) -> LaunchDescription | None:
        """Return the description if its file is known without a context, or None otherwise."""
        if self.__launch_description is None:
            parts = self.__location
            if not all(isinstance(part, TextSubstitution) for part in parts):
                return None
            location = "".join(part.text for part in parts if isinstance(part, TextSubstitution))
            if not Path(location).is_file():
                return None
            self.__expanded_location = str(Path(location).absolute())
            self.__launch_description = self._get_launch_description(self.__expanded_location)
        return self.__launch_description

    def get_launch_description(self, context: LaunchContext) -> LaunchDescription:
        """Return the description; read the file at the first call."""
        if self.__expanded_location is None:
            location = perform_substitutions(context, self.__location)
            if not location.startswith("<"):
                location = str(Path(location).absolute())
            self.__expanded_location = location
        if self.__launch_description is None:
            self.__launch_description = self._get_launch_description(self.__expanded_location)
        return self.__launch_description

    def _get_launch_description(self, location: str) -> LaunchDescription:
        raise NotImplementedError(f"This source does not read launch files; {location!r} cannot be read.")
