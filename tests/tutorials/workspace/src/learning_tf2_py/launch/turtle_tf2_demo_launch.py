# SPDX-License-Identifier: Apache-2.0
"""The simulator, both broadcasters, and the turtle that follows."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package="turtlesim", executable="turtlesim_node", name="sim"),
            Node(
                package="learning_tf2_py",
                executable="turtle_tf2_broadcaster",
                name="broadcaster1",
                parameters=[{"turtlename": "turtle1"}],
            ),
            DeclareLaunchArgument("target_frame", default_value="turtle1", description="Target frame name."),
            Node(
                package="learning_tf2_py",
                executable="turtle_tf2_broadcaster",
                name="broadcaster2",
                parameters=[{"turtlename": "turtle2"}],
            ),
            Node(
                package="learning_tf2_py",
                executable="turtle_tf2_listener",
                name="listener",
                output="screen",
                parameters=[{"target_frame": LaunchConfiguration("target_frame")}],
            ),
        ]
    )
