# SPDX-License-Identifier: Apache-2.0
"""The substitution of a path that is joined from parts."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["PathJoinSubstitution", "PathSubstitution"]


@expose_substitution("path-join")
class PathJoinSubstitution(Substitution):
    """A path that is joined from parts; ``PathJoinSubstitution(...) / "file"`` appends to it."""

    def __init__(self, substitutions: Iterable[SomeSubstitutionsType]) -> None:
        self.__substitutions = [normalize_to_list_of_substitutions(part) for part in substitutions]

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(path-join PART...)``."""
        if not data:
            raise TypeError("path-join substitution expects at least 1 argument")
        return cls, {"substitutions": data}

    @property
    def substitutions(self) -> list[list[Substitution]]:
        """The parts."""
        return self.__substitutions

    def __truediv__(self, addition: SomeSubstitutionsType) -> PathJoinSubstitution:
        return PathJoinSubstitution([*self.__substitutions, addition])

    def describe(self) -> str:
        """Return a one-line description."""
        parts = (" + ".join(each.describe() for each in part) for part in self.__substitutions)
        return f"PathJoin({', '.join(parts)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        parts = [perform_substitutions(context, part) for part in self.__substitutions]
        return os.path.join(*parts) if parts else ""  # noqa: PTH118 - the first part may be empty


class PathSubstitution(PathJoinSubstitution):
    """A path to which parts can be appended: ``PathSubstitution(FindPackageShare("p")) / "launch"``."""

    def __init__(self, path: SomeSubstitutionsType) -> None:
        super().__init__([path])
