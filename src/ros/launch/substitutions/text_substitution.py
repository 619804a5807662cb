# SPDX-License-Identifier: Apache-2.0
"""The substitution with a constant string."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["TextSubstitution"]


class TextSubstitution(Substitution):
    """A constant string.

    Raises:
        TypeError: The text is not a string.
    """

    def __init__(self, *, text: str) -> None:
        if not isinstance(text, str):
            raise TypeError(f"TextSubstitution expected Text object got '{type(text)}' instead.")
        self.__text = text

    @property
    def text(self) -> str:
        """The string."""
        return self.__text

    def describe(self) -> str:
        """Return the string in quotes."""
        return f"'{self.text}'"

    def perform(self, context: LaunchContext) -> str:
        """Return the string."""
        del context
        return self.text
