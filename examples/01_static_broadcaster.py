# SPDX-License-Identifier: Apache-2.0
"""Publish where two sensors are mounted, once, on /tf_static.

Late joiners receive static transforms too. The file uses ROS 2's own packages, so it also runs on a real ROS 2.

Run it with 02_dynamic_broadcaster.py and 03_listener.py in two other terminals, and look at the tree with
`coframe view`. Ctrl-C ends each of them.
"""

from __future__ import annotations

import contextlib
import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from tf2_ros import StaticTransformBroadcaster


class SensorMounts(Node):
    """A node that publishes the mounts of a lidar and a camera."""

    def __init__(self) -> None:
        super().__init__("sensor_mounts")
        self.broadcaster = StaticTransformBroadcaster(self)
        lidar = self.mount("lidar_link", x=0.1, z=0.3, pitch=0.0)
        camera = self.mount("camera_link", x=0.2, z=0.2, pitch=math.radians(15))
        # All static transforms of a node go into one call: the second call would not replace the first.
        self.broadcaster.sendTransform([lidar, camera])

    def mount(self, child: str, *, x: float, z: float, pitch: float) -> TransformStamped:
        """Return base_link -> child; x and z in meters, pitch (about y, positive looks down) in radians."""
        transform = TransformStamped()
        transform.header.stamp = self.get_clock().now().to_msg()
        transform.header.frame_id = "base_link"
        transform.child_frame_id = child
        transform.transform.translation.x = x
        transform.transform.translation.z = z
        transform.transform.rotation.y = math.sin(pitch / 2)
        transform.transform.rotation.w = math.cos(pitch / 2)
        return transform


def main() -> None:
    rclpy.init()
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(SensorMounts())


if __name__ == "__main__":
    main()
