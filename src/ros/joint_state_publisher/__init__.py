"""joint_state_publisher as a node of rclpy: joint states from a robot's description and what other sources say."""

from joint_state_publisher._node import JointStatePublisher, main, run

__all__ = ["JointStatePublisher", "main", "run"]
