# SPDX-License-Identifier: Apache-2.0
"""The event that an action has finished."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.action import Action

__all__ = ["ExecutionComplete"]


class ExecutionComplete(Event):
    """An action has finished."""

    name = "launch.events.ExecutionComplete"

    def __init__(self, *, action: Action) -> None:
        self.__action = action

    @property
    def action(self) -> Action:
        """The action."""
        return self.__action
