"""Telling message and service types from anything else."""

from __future__ import annotations

from typing import Any

from rclpy.exceptions import NoTypeSupportImportedException


def check_is_valid_msg_type(msg_type: Any) -> None:
    """Returns if it is a message class.

    Raises:
        NoTypeSupportImportedException: It is not.
    """
    _check(msg_type, "msg", "a message type such as std_msgs.msg.String")


def check_is_valid_srv_type(srv_type: Any) -> None:
    """Returns if it is a service class.

    Raises:
        NoTypeSupportImportedException: It is not.
    """
    _check(srv_type, "srv", "a service type such as std_srvs.srv.SetBool")


def _check(some_type: Any, folder: str, expected: str) -> None:
    name = getattr(some_type, "ROS_TYPE", "")
    if f"/{folder}/" not in name and not (folder == "msg" and name):
        raise NoTypeSupportImportedException(f"expected {expected}, got {some_type!r}")
    if not isinstance(some_type, type):
        raise NoTypeSupportImportedException(f"expected the class {type(some_type).__name__}, got an object of it")
