# SPDX-License-Identifier: Apache-2.0
"""The substitution of the folder of the log files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import launch.logging
from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["LaunchLogDir"]


@expose_substitution("launch_log_dir")
@expose_substitution("log_dir")
class LaunchLogDir(Substitution):
    """The folder of the log files of this launch."""

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(launch_log_dir)``."""
        check_arguments("launch_log_dir", data, 0, 0)
        return cls, {}

    def describe(self) -> str:
        """Return a one-line description."""
        return "LaunchLogDir()"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        del context
        return launch.logging.launch_config.log_dir
