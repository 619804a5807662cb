# SPDX-License-Identifier: Apache-2.0
"""A node that publishes joint states far from the simulated motion of the lab.

If a student's node continues its own simulation next to them, the arm visibly jumps between two poses.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import rclpy
from rclpy.executors import ExternalShutdownException
from sensor_msgs.msg import JointState

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ["main"]

_RATE = 50.0  # Hz
_CENTERS, _AMPLITUDE, _FREQUENCY = (1.2, -0.9), 0.2, 0.1  # radians and Hz
_NAMES = ("joint2", "joint1")  # not in the order of the arm: nodes must find joints by name


def _publish(node: Node) -> None:
    publisher = node.create_publisher(JointState, "/joint_states", 10)

    def publish() -> None:
        now = node.get_clock().now()
        swing = _AMPLITUDE * math.sin(2.0 * math.pi * _FREQUENCY * now.nanoseconds / 1e9)
        state = JointState(name=list(_NAMES), position=[_CENTERS[1] - swing, _CENTERS[0] + swing])
        state.header.stamp = now.to_msg()
        publisher.publish(state)

    node.create_timer(1.0 / _RATE, publish)
    node.get_logger().info("Publishing the joint states of the robot: the arm follows them")


def main() -> None:
    """Run the node until it is interrupted."""
    rclpy.init()
    node = rclpy.create_node("simulated_joints")
    try:
        _publish(node)
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
