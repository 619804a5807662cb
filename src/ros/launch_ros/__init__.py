# SPDX-License-Identifier: Apache-2.0
"""Launch files for ROS nodes: actions, substitutions and events on top of `launch`."""

from coframe.workspace import ros_side

ros_side.check(__name__)

from launch_ros import (
    actions,
    descriptions,
    event_handlers,
    events,
    parameter_descriptions,
    ros_adapters,
    substitutions,
    utilities,
)

__all__ = [
    "actions",
    "descriptions",
    "event_handlers",
    "events",
    "parameter_descriptions",
    "ros_adapters",
    "substitutions",
    "utilities",
]
