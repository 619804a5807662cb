# SPDX-License-Identifier: Apache-2.0
"""joint_state_publisher as an rclpy node, which combines joint states from a robot description and other sources."""

from coframe.nodes.joint_state_publisher import run
from joint_state_publisher.joint_state_publisher import JointStatePublisher, main

__all__ = ["JointStatePublisher", "main", "run"]
