# SPDX-License-Identifier: Apache-2.0
"""Services with which other programs read and change the log levels of a process."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import LoggerLevel, SetLoggerLevelsResult
from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels
from rclpy import _absent
from rclpy.impl.console import console
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.logging import set_logger_level
from rclpy.qos import qos_profile_services_default

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ["LoggingService"]


class LoggingService:
    """Services `~/get_logger_levels` and `~/set_logger_levels` of a node. See `enable_logger_service` of `Node`.

    Args:
        node: Node that serves them.
    """

    def __init__(self, node: Node) -> None:
        for srv_type, name, callback in (
            (GetLoggerLevels, "get_logger_levels", self.__get),
            (SetLoggerLevels, "set_logger_levels", self.__set),
        ):
            node.create_service(srv_type, f"~/{name}", callback, qos_profile=qos_profile_services_default)

    def __get(self, request: Any, response: Any) -> Any:
        response.levels = [
            LoggerLevel(name=name, level=console.levels.get(name, LoggingSeverity.UNSET)) for name in request.names
        ]
        return response

    def __set(self, request: Any, response: Any) -> Any:
        response.results = [_set(level.name, level.level) for level in request.levels]
        return response


def _set(name: str, level: int) -> SetLoggerLevelsResult:
    try:
        set_logger_level(name, level)
    except ValueError as error:
        return SetLoggerLevelsResult(successful=False, reason=str(error))
    return SetLoggerLevelsResult(successful=True)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
