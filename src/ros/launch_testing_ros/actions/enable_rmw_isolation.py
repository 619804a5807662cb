# SPDX-License-Identifier: Apache-2.0
"""The action that separates a test from other nodes of the network."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["EnableRmwIsolation"]

_DOMAIN_COUNT = 101  # the number of domains whose ports no system takes for other sockets


class EnableRmwIsolation(Action):
    """Let the processes of a test use a separate domain, only on this machine.

    ROS_DOMAIN_ID is kept if it is set.
    """

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the environment variables."""
        context.environment.setdefault("ROS_DOMAIN_ID", str(1 + os.getpid() % _DOMAIN_COUNT))
        context.environment["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        return None
