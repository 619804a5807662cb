# SPDX-License-Identifier: Apache-2.0
"""The nodes robot_state_publisher and joint_state_publisher.

They use only the API of rclpy, tf2_ros and the message packages, so they also run on a sourced ROS. A sourced ROS may
have its own package joint_state_publisher, so the commands import the nodes from here.
"""
