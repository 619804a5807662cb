# SPDX-License-Identifier: Apache-2.0
"""Predicates for the targets of events."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.action import Action

__all__ = ["matches_action"]


def matches_action(target_action: Action) -> Callable[[Action], bool]:
    """Return a predicate that holds only for this action."""
    return lambda action: action is target_action
