# SPDX-License-Identifier: Apache-2.0
"""The substitution of a launch configuration that is true or false."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitutions import LaunchConfiguration

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["LaunchConfigAsBool"]

_TRUE = {"true", "1", "yes", "on"}


class LaunchConfigAsBool(LaunchConfiguration):
    """A launch configuration as ``True`` or ``False``; true, 1, yes and on are true."""

    def __init__(self, name: str) -> None:
        super().__init__(name)

    def perform(self, context: LaunchContext) -> str:
        """Return ``True`` or ``False``."""
        return str(super().perform(context).strip().lower() in _TRUE)
