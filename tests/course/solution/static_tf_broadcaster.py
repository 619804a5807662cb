# SPDX-License-Identifier: Apache-2.0
"""Step 1: the sensor mounts."""

import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import StaticTransformBroadcaster

HALF = math.sqrt(0.5)
MOUNTS = [
    ("end_effector", "camera_link", (0.05, 0.0, 0.02), (0.0, HALF, 0.0, HALF)),
    ("base_link", "imu_link", (0.0, 0.0, 0.1), (0.0, 0.0, 0.0, 1.0)),
    ("base_link", "lidar_link", (0.0, 0.0, 0.5), (0.0, 0.0, 0.0, 1.0)),
]


class StaticFramePublisher(Node):
    def __init__(self):
        super().__init__("static_tf_broadcaster")
        self.broadcaster = StaticTransformBroadcaster(self)
        self.broadcaster.sendTransform([self.make(*mount) for mount in MOUNTS])

    def make(self, parent, child, position, rotation):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = parent
        t.child_frame_id = child
        t.transform.translation.x, t.transform.translation.y, t.transform.translation.z = position
        q = t.transform.rotation
        q.x, q.y, q.z, q.w = rotation
        return t


def main():
    rclpy.init()
    node = StaticFramePublisher()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
