# SPDX-License-Identifier: Apache-2.0
"""Substitutions that compare two strings."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["EqualsSubstitution", "NotEqualsSubstitution"]


_TRUTH = {"true": True, "1": True, "false": False, "0": False}


@expose_substitution("equals")
class EqualsSubstitution(Substitution):
    """Whether two strings are equal, even as booleans or numbers."""

    def __init__(self, left: Any, right: Any) -> None:
        self.__left = _normalize(left)
        self.__right = _normalize(right)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(equals LEFT RIGHT)`` or ``$(not-equals LEFT RIGHT)``."""
        check_arguments("equals", data, 2, 2)
        return cls, {"left": data[0], "right": data[1]}

    @property
    def left(self) -> list[Substitution]:
        """The first operand."""
        return self.__left

    @property
    def right(self) -> list[Substitution]:
        """The second operand."""
        return self.__right

    def describe(self) -> str:
        """Return a one-line description."""
        parts = (" + ".join(each.describe() for each in part) for part in (self.left, self.right))
        return f"{type(self).__name__}({' '.join(parts)})"

    def _are_equal(self, context: LaunchContext) -> bool:
        left, right = (perform_substitutions(context, part) for part in (self.left, self.right))
        if left == right:
            return True
        if left.lower() in _TRUTH and right.lower() in _TRUTH:
            return _TRUTH[left.lower()] is _TRUTH[right.lower()]
        try:
            return math.isclose(float(left), float(right))
        except ValueError:
            return False

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return "true" if self._are_equal(context) else "false"


@expose_substitution("not-equals")
class NotEqualsSubstitution(EqualsSubstitution):
    """Whether two strings differ, even as booleans and numbers."""

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return "false" if self._are_equal(context) else "true"


def _normalize(value: Any) -> list[Substitution]:
    if value is None or isinstance(value, bool | int | float):
        return normalize_to_list_of_substitutions("" if value is None else str(value))
    return normalize_to_list_of_substitutions(value)
