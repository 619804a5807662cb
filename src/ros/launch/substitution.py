# SPDX-License-Identifier: Apache-2.0
"""Base class of substitutions: strings that are computed while a launch description is visited."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["Substitution"]


class Substitution:
    """Text that is computed when it is needed, from the launch context."""

    def describe(self) -> str:
        """Return a one-line description."""
        return self.__repr__()

    def perform(self, context: LaunchContext) -> str:
        """Return the string."""
        del context
        return ""
