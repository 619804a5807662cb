# SPDX-License-Identifier: Apache-2.0
"""robot_state_publisher as an rclpy node, which publishes transforms from a robot description and joint states."""

from coframe.nodes.program import program, spin_until_shutdown
from coframe.nodes.robot_state_publisher import RobotStatePublisher, main, run

__all__ = ["RobotStatePublisher", "main", "program", "run", "spin_until_shutdown"]
