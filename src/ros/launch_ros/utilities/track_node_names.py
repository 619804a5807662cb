# SPDX-License-Identifier: Apache-2.0
"""The number of started nodes of each name, to warn about duplicates."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["add_node_name", "get_node_name_count"]

_KEY = "unique_ros_node_names"


def add_node_name(context: LaunchContext, node_name: str) -> None:
    """Count a node."""
    counts = context.get_locals_as_dict().get(_KEY, {})
    context.extend_globals({_KEY: {**counts, node_name: counts.get(node_name, 0) + 1}})


def get_node_name_count(context: LaunchContext, node_name: str) -> int:
    """Return how many nodes of this name were started."""
    count: int = context.get_locals_as_dict().get(_KEY, {}).get(node_name, 0)
    return count
