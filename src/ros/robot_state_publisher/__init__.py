"""robot_state_publisher as a node of rclpy: transforms from a robot's description and its joint states."""

from robot_state_publisher._node import RobotStatePublisher, main, run
from robot_state_publisher._program import program, spin_until_ended

__all__ = ["RobotStatePublisher", "main", "program", "run", "spin_until_ended"]
