# SPDX-License-Identifier: Apache-2.0
"""Starts the node with another value of its parameter."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(
                package="python_parameters",
                executable="minimal_param_node",
                name="custom_minimal_param_node",
                output="screen",
                emulate_tty=True,
                parameters=[{"my_parameter": "earth"}],
            )
        ]
    )
