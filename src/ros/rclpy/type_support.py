# SPDX-License-Identifier: Apache-2.0
"""Checks of message, service and action types."""

from __future__ import annotations

from typing import Any

from rclpy.exceptions import NoTypeSupportImportedException


def check_is_valid_msg_type(msg_type: Any) -> None:
    """Raise an error unless `msg_type` is a message class.

    Raises:
        NoTypeSupportImportedException: The type is not such a class.
    """
    _check(msg_type, "SLOT_TYPES", "a message type such as std_msgs.msg.String")


def check_is_valid_srv_type(srv_type: Any) -> None:
    """Raise an error unless `srv_type` is a service class.

    Raises:
        NoTypeSupportImportedException: The type is not such a class.
    """
    _check(srv_type, "Request", "a service type such as std_srvs.srv.SetBool")


def check_is_valid_action_type(action_type: Any) -> None:
    """Raise an error unless `action_type` is an action class.

    Raises:
        NoTypeSupportImportedException: The type is not such a class.
    """
    _check(action_type, "Goal", "an action type such as tf2_msgs.action.LookupTransform")


def _check(some_type: Any, part: str, expected: str) -> None:
    if not (hasattr(some_type, "ROS_TYPE") and hasattr(some_type, part)):
        raise NoTypeSupportImportedException(f"Expected {expected}, got {some_type!r}.")
    if not isinstance(some_type, type):
        raise NoTypeSupportImportedException(f"Expected the class {type(some_type).__name__}, got an instance of it.")
