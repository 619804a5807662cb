# SPDX-License-Identifier: Apache-2.0
"""robot_state_publisher as an rclpy node, which publishes transforms from a robot description and joint states."""

from robot_state_publisher._node import RobotStatePublisher, main, run
from robot_state_publisher._program import program, spin_until_shutdown

__all__ = ["RobotStatePublisher", "main", "program", "run", "spin_until_shutdown"]
