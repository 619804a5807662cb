# SPDX-License-Identifier: Apache-2.0
"""The event that the period of a timer has elapsed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.actions.timer_action import TimerAction

__all__ = ["TimerEvent"]


class TimerEvent(Event):
    """The period of a timer has elapsed."""

    name = "launch.events.TimerEvent"

    def __init__(self, *, timer_action: TimerAction) -> None:
        self.__timer_action = timer_action

    @property
    def timer_action(self) -> TimerAction:
        """The timer."""
        return self.__timer_action
