# SPDX-License-Identifier: Apache-2.0
"""Extension 3: two robots in one tree."""

import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster


class MultiRobot(Node):
    def __init__(self):
        super().__init__("multi_robot")
        self.static_broadcaster = StaticTransformBroadcaster(self)
        self.broadcaster = TransformBroadcaster(self)
        self.static_broadcaster.sendTransform(
            [
                self.make("map", "robot1/base_link", (0.0, 1.0, 0.0)),
                self.make("map", "robot2/base_link", (0.0, -1.0, 0.0)),
            ]
        )
        self.create_timer(0.02, self.publish)

    def publish(self):
        t = self.get_clock().now().nanoseconds / 1e9
        for prefix in ("robot1/", "robot2/"):
            q1 = 0.5 * math.sin(2 * math.pi * 0.2 * t)
            q2 = 0.3 * math.sin(2 * math.pi * 0.3 * t + math.pi / 4)
            self.broadcaster.sendTransform(
                [
                    self.make(prefix + "base_link", prefix + "link1", (0.0, 0.0, 0.1), q1),
                    self.make(prefix + "link1", prefix + "link2", (0.5, 0.0, 0.0), q2),
                    self.make(prefix + "link2", prefix + "end_effector", (0.4, 0.0, 0.0)),
                ]
            )

    def make(self, parent, child, position, yaw=0.0):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = parent
        t.child_frame_id = child
        t.transform.translation.x, t.transform.translation.y, t.transform.translation.z = position
        t.transform.rotation.z = math.sin(yaw / 2)
        t.transform.rotation.w = math.cos(yaw / 2)
        return t


rclpy.init()
try:
    rclpy.spin(MultiRobot())
except KeyboardInterrupt:
    pass
