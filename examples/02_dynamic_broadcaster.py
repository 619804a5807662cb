# SPDX-License-Identifier: Apache-2.0
"""Publish a robot that drives on a circle: odom -> base_link on /tf, 50 times a second.

The file uses ROS 2's own packages, so it also runs on a real ROS 2.
"""

from __future__ import annotations

import contextlib
import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from tf2_ros import TransformBroadcaster

RADIUS = 2.0  # meters
SPEED = 0.5  # radians per second around the center
RATE = 50.0  # hertz


class CirclingBase(Node):
    """A node that publishes a pose on a circle."""

    def __init__(self) -> None:
        super().__init__("circling_base")
        self.broadcaster = TransformBroadcaster(self)
        self.start = self.get_clock().now()
        self.timer = self.create_timer(1 / RATE, self.publish)

    def publish(self) -> None:
        """Publish the pose at the current time."""
        now = self.get_clock().now()
        angle = SPEED * (now - self.start).nanoseconds * 1e-9
        heading = angle + math.pi / 2  # the robot looks along its path
        transform = TransformStamped()
        transform.header.stamp = now.to_msg()
        transform.header.frame_id = "odom"
        transform.child_frame_id = "base_link"
        transform.transform.translation.x = RADIUS * math.cos(angle)
        transform.transform.translation.y = RADIUS * math.sin(angle)
        transform.transform.rotation.z = math.sin(heading / 2)
        transform.transform.rotation.w = math.cos(heading / 2)
        self.broadcaster.sendTransform(transform)


def main() -> None:
    rclpy.init()
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(CirclingBase())


if __name__ == "__main__":
    main()
