# SPDX-License-Identifier: Apache-2.0
"""Names that programs import from the native module of upstream's rclpy: mainly its exceptions.

RuntimeError
├── InvalidHandle                  a destroyed node, publisher or other entity was used
├── RCLError                       an operation of the ROS client library failed
│   ├── RCLInvalidROSArgsError     arguments after --ros-args are malformed
│   ├── NodeNameNonExistentError   no node has the requested name
│   └── UnsupportedEventTypeError  a QoS event is not supported
├── UnknownROSArgsError            arguments after --ros-args are unknown
├── RMWError                       an operation of the middleware failed
└── RCUtilsError                   an operation of the logging or name library failed
"""

from __future__ import annotations

from importlib import import_module
from typing import Any, Final

# Names that upstream defines in its native module and that are defined in a separate module here.
_OTHER_MODULES: Final = {
    "ClockChange": "rclpy.clock",
    "ClockType": "rclpy._clock_type",
    "GoalEvent": "rclpy.action.server",
    "SignalHandlerOptions": "rclpy.signals",
    "rclpy_deserialize": "rclpy.serialization:deserialize_message",
    "rclpy_get_rmw_implementation_identifier": "rclpy.utilities:get_rmw_implementation_identifier",
    "rclpy_remove_ros_args": "rclpy.utilities:remove_ros_args",
    "rclpy_serialize": "rclpy.serialization:serialize_message",
}


class RCLError(RuntimeError):
    """An operation of the ROS client library failed."""


class RCLInvalidROSArgsError(RCLError):
    """Arguments after `--ros-args` are malformed."""


class UnknownROSArgsError(RuntimeError):
    """Arguments after `--ros-args` are unknown."""


class NodeNameNonExistentError(RCLError):
    """No node has the requested name."""


class UnsupportedEventTypeError(RCLError):
    """A QoS event is not supported."""


class RMWError(RuntimeError):
    """An operation of the middleware failed."""


class RCUtilsError(RuntimeError):
    """An operation of the logging or name library failed."""


class InvalidHandle(RuntimeError):
    """A destroyed node, publisher, subscription or other entity was used."""


def __getattr__(name: str) -> Any:
    if name in _OTHER_MODULES:
        module, _, attribute = _OTHER_MODULES[name].partition(":")
        return getattr(import_module(module), attribute or name)
    raise AttributeError(
        f"{__name__} has no attribute {name!r}: coframe has no native module of rclpy. Use rclpy's public classes."
    )
