# SPDX-License-Identifier: Apache-2.0
"""Predicates for the nodes that an event is for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["matches_node_name"]


def matches_node_name(node_name: str) -> Callable[[Any], bool]:
    """Return a predicate for the node with this name and namespace."""
    absolute = node_name if node_name.startswith("/") else f"/{node_name}"
    return lambda action: bool(action.node_name == absolute)
