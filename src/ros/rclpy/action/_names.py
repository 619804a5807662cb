"""The services and topics that an action consists of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from rclpy.exceptions import InvalidServiceNameException
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
    """Returns the fully qualified name of an action, remapped; rules for single services and topics come on top.

    Args:
        node: The node that uses it.
        action_name: The name as users write it.
        user: What is made for it, for the error's text.

    Raises:
        ValueError: The name breaks a rule.
    """
    try:
        return node.resolve_service_name(action_name)
    except InvalidServiceNameException as error:
        raise ValueError(
            f"Failed to create {user} due to invalid topic name '{action_name}': {error.error_msg}"
        ) from error
