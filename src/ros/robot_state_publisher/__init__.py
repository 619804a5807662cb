"""robot_state_publisher as a node of rclpy: transforms from a robot's description and its joint states."""

from robot_state_publisher._node import RobotStatePublisher, main, run

__all__ = ["RobotStatePublisher", "main", "run"]
