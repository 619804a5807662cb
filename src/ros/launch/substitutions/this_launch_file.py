# SPDX-License-Identifier: Apache-2.0
"""The substitution of the path of the launch file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["ThisLaunchFile"]


@expose_substitution("filename")
class ThisLaunchFile(Substitution):
    """The path of the launch file that is being visited."""

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(filename)``."""
        check_arguments("filename", data, 0, 0)
        return cls, {}

    def describe(self) -> str:
        """Return a one-line description."""
        return "ThisLaunchFile()"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        path = context.get_locals_as_dict().get("current_launch_file_path")
        if path is None:
            raise SubstitutionFailure("ThisLaunchFile used outside of a launch file (in a script)")
        return str(path)
