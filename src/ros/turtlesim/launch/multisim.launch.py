# SPDX-License-Identifier: Apache-2.0
"""Two simulators, in the namespaces turtlesim1 and turtlesim2."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Return both nodes."""
    return LaunchDescription(
        [
            Node(package="turtlesim", executable="turtlesim_node", namespace=namespace, output="screen")
            for namespace in ("turtlesim1", "turtlesim2")
        ]
    )
