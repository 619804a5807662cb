# SPDX-License-Identifier: Apache-2.0
"""Print where the lidar is relative to odom, twice a second.

The file uses ROS 2's own packages, so it also runs on a real ROS 2.
"""

from __future__ import annotations

import contextlib

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener


class LidarPosition(Node):
    """A node that looks up odom <- lidar_link."""

    def __init__(self) -> None:
        super().__init__("lidar_position")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.timer = self.create_timer(0.5, self.report)

    def report(self) -> None:
        """Log the latest position, or why there is none."""
        try:
            # Target first, then source: the result transforms data from lidar_link into odom. Time() is the latest.
            transform = self.buffer.lookup_transform("odom", "lidar_link", Time())
        except TransformException as error:
            self.get_logger().warning(str(error))
            return
        position = transform.transform.translation
        self.get_logger().info(f"lidar at x={position.x:.2f} y={position.y:.2f} z={position.z:.2f} m in odom")


def main() -> None:
    rclpy.init()
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(LidarPosition())


if __name__ == "__main__":
    main()
