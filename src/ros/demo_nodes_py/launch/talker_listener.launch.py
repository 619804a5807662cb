# SPDX-License-Identifier: Apache-2.0
"""The nodes talker and listener."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Return both nodes."""
    return LaunchDescription(
        [Node(package="demo_nodes_cpp", executable=name, output="screen") for name in ("talker", "listener")]
    )
