# SPDX-License-Identifier: Apache-2.0
"""The event that a lifecycle node has changed its state."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event import Event

if TYPE_CHECKING:
    from launch_ros.actions.lifecycle_node import LifecycleNode

__all__ = ["StateTransition"]


class StateTransition(Event):
    """A lifecycle node has changed its state.

    Args:
        action: The action that has started the node.
        msg: The message lifecycle_msgs.msg.TransitionEvent.
    """

    name = "launch_ros.events.lifecycle.StateTransition"

    def __init__(self, *, action: LifecycleNode, msg: Any) -> None:
        self.__action = action
        self.__msg = msg

    @property
    def action(self) -> LifecycleNode:
        """The action that has started the node."""
        return self.__action

    @property
    def msg(self) -> Any:
        """The message."""
        return self.__msg

    @property
    def timestamp(self) -> int:
        """The time of the transition."""
        return int(self.__msg.timestamp)

    @property
    def transition(self) -> str:
        """The name of the transition."""
        return str(self.__msg.transition.label)

    @property
    def transition_id(self) -> int:
        """The number of the transition."""
        return int(self.__msg.transition.id)

    @property
    def start_state(self) -> str:
        """The name of the state before."""
        return str(self.__msg.start_state.label)

    @property
    def start_state_id(self) -> int:
        """The number of the state before."""
        return int(self.__msg.start_state.id)

    @property
    def goal_state(self) -> str:
        """The name of the state after."""
        return str(self.__msg.goal_state.label)

    @property
    def goal_state_id(self) -> int:
        """The number of the state after."""
        return int(self.__msg.goal_state.id)
