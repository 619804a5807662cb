# SPDX-License-Identifier: Apache-2.0
"""Names of the services and topics of an action."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from rclpy.exceptions import RCLError
from rclpy.qos import QoSProfile

if TYPE_CHECKING:
    from rclpy.node import Node

SEND_GOAL: Final = "/_action/send_goal"
CANCEL_GOAL: Final = "/_action/cancel_goal"
GET_RESULT: Final = "/_action/get_result"
FEEDBACK: Final = "/_action/feedback"
STATUS: Final = "/_action/status"

FEEDBACK_QOS: Final = QoSProfile(depth=10)


def resolve_action_name(node: Node, action_name: str, user: str) -> str:
    """Return the fully qualified name of an action, remapped. Rules for its services and topics apply in addition.

    Args:
        node: Node that uses the action.
        action_name: Name of the action, which may be relative.
        user: Kind of entity that is created, for the error message.

    Raises:
        ValueError: The name is not valid.
    """
    try:
        return node.resolve_service_name(action_name)
    except RCLError as error:
        raise ValueError(f"Failed to create {user} due to invalid topic name '{action_name}': {error}") from error
