# SPDX-License-Identifier: Apache-2.0
"""Actions: long-running goals with feedback, cancellation and a result."""

from functools import partial

from rclpy import _absent
from rclpy.action.client import ActionClient, ClientGoalHandle
from rclpy.action.graph import (
    get_action_client_names_and_types_by_node,
    get_action_names_and_types,
    get_action_server_names_and_types_by_node,
)
from rclpy.action.server import ActionServer, CancelResponse, GoalResponse, ServerGoalHandle

__all__ = [
    "ActionClient",
    "ActionServer",
    "CancelResponse",
    "ClientGoalHandle",
    "GoalResponse",
    "ServerGoalHandle",
    "get_action_client_names_and_types_by_node",
    "get_action_names_and_types",
    "get_action_server_names_and_types_by_node",
]

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
