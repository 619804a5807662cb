# SPDX-License-Identifier: Apache-2.0
"""What pages may do on the graph with a permission: publish, call, set parameters, send goals, drive.

The commands implement it, because only they use rclpy.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from coframe.errors import CoframeError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe.viewer.protocol.common import ControlKind

__all__ = ["ControlError", "ControlField", "GraphControl"]


class ControlError(CoframeError, ValueError):
    """Something that a page wanted to do on the graph has failed.

    Attributes:
        hint: Advice for the user.
    """

    def __init__(self, text: str, hint: str = "") -> None:
        super().__init__(text)
        self._hint = hint


class ControlField(NamedTuple):
    """A field of a form or of an answer: its path, such as ``linear.x``, its type, and its value as JSON."""

    path: str
    type: str
    value: str


class GraphControl(Protocol):
    """The permission to act on the graph. Used by background threads, one request of a page after another."""

    def names(self, kind: ControlKind) -> dict[str, str]:
        """Return the names of topics, services, actions or nodes with their types, or "" for nodes."""

    def form(self, kind: ControlKind, name: str, ros_type: str) -> tuple[str, list[ControlField]]:
        """Return the type of a topic, service or action, and the fields of its message, request or goal.

        For a node, the fields are its parameters.

        Raises:
            ControlError: The type or the node does not exist.
        """

    def act(
        self, kind: ControlKind, name: str, ros_type: str, values: Mapping[str, Any]
    ) -> tuple[str, list[ControlField]]:
        """Publish a message, call a service, send a goal and wait for its result, or set parameters.

        Args:
            kind: What the name belongs to.
            name: The topic, service, action or node.
            ros_type: The type; for nodes, it is ignored.
            values: The fields that differ from the default, nested; for nodes, parameters by name.

        Returns:
            What has happened, and the fields of the answer.

        Raises:
            ControlError: It has failed.
        """

    def drive(self, topic: str, ros_type: str, linear: tuple[float, float], angular: float) -> None:
        """Publish a velocity repeatedly until the next one; without one for half a second, publish zero and stop.

        Args:
            topic: The topic.
            ros_type: Twist or TwistStamped of geometry_msgs.
            linear: The velocities along x and y in meters per second.
            angular: The velocity around z in radians per second.
        """

    def close(self) -> None:
        """Stop driving, and leave the graph."""
