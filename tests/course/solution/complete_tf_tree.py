# SPDX-License-Identifier: Apache-2.0
"""Step 6: the complete tree."""

import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

HALF = math.sqrt(0.5)
NO_ROTATION = (0.0, 0.0, 0.0, 1.0)


class CompleteTFTree(Node):
    def __init__(self):
        super().__init__("complete_tf_tree")
        self.static_broadcaster = StaticTransformBroadcaster(self)
        self.broadcaster = TransformBroadcaster(self)
        self.static_broadcaster.sendTransform(
            [
                self.make("world", "map", (0.0, 0.0, 0.0)),
                self.make("base_link", "imu_link", (0.0, 0.0, 0.1)),
                self.make("base_link", "lidar_link", (0.0, 0.0, 0.5)),
                self.make("end_effector", "camera_link", (0.05, 0.0, 0.02), (0.0, HALF, 0.0, HALF)),
            ]
        )
        self.start = None
        self.create_timer(0.02, self.publish)

    def publish(self):
        now = self.get_clock().now()
        self.start = self.start or now
        t = (now - self.start).nanoseconds / 1e9
        q1 = 0.5 * math.sin(2 * math.pi * 0.2 * t)
        q2 = 0.3 * math.sin(2 * math.pi * 0.3 * t + math.pi / 4)
        base = (0.1 * t, 0.05 * math.sin(0.5 * t), 0.0)
        self.broadcaster.sendTransform(
            [
                self.make("map", "odom", (0.001 * t, 0.0005 * t, 0.0)),
                self.make("odom", "base_link", base, yaw(0.1 * math.sin(0.2 * t))),
                self.make("base_link", "link1", (0.0, 0.0, 0.1), yaw(q1)),
                self.make("link1", "link2", (0.5, 0.0, 0.0), yaw(q2)),
                self.make("link2", "end_effector", (0.4, 0.0, 0.0)),
            ]
        )

    def make(self, parent, child, position, rotation=NO_ROTATION):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = parent
        t.child_frame_id = child
        t.transform.translation.x, t.transform.translation.y, t.transform.translation.z = position
        q = t.transform.rotation
        q.x, q.y, q.z, q.w = rotation
        return t


def yaw(angle):
    return (0.0, 0.0, math.sin(angle / 2), math.cos(angle / 2))


def main():
    rclpy.init()
    node = CompleteTFTree()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
