# SPDX-License-Identifier: Apache-2.0
"""The request that lifecycle nodes change their state."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from launch.event import Event

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.action import Action

__all__ = ["ChangeState"]


class ChangeState(Event):
    """A request that lifecycle nodes change their state.

    Args:
        lifecycle_node_matcher: Predicate for the actions that have started the nodes.
        transition_id: The transition, a constant of lifecycle_msgs.msg.Transition.
    """

    name = "launch_ros.events.lifecycle.ChangeState"

    # The constants of lifecycle_msgs.msg.Transition; its package is slow to import.
    valid_transitions: ClassVar[dict[int, str]] = {
        0: "create",
        1: "configure",
        2: "cleanup",
        3: "activate",
        4: "deactivate",
        5: "unconfigured_shutdown",
        6: "inactive_shutdown",
        7: "active_shutdown",
        8: "destroy",
    }

    def __init__(self, *, lifecycle_node_matcher: Callable[[Action], bool], transition_id: int) -> None:
        if transition_id not in self.valid_transitions:
            known = ", ".join(f"{number} ({name})" for number, name in self.valid_transitions.items())
            raise ValueError(f"transition_id {transition_id!r} is not a transition. Known transitions: {known}")
        self.__lifecycle_node_matcher = lifecycle_node_matcher
        self.__transition_id = transition_id

    @property
    def lifecycle_node_matcher(self) -> Callable[[Action], bool]:
        """The predicate for the actions that have started the nodes."""
        return self.__lifecycle_node_matcher

    @property
    def transition_id(self) -> int:
        """The transition."""
        return self.__transition_id
