# SPDX-License-Identifier: Apache-2.0
"""Step 2: the moving arm."""

import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from sensor_msgs.msg import JointState
from tf2_ros import TransformBroadcaster

HEIGHT, LENGTHS, RATE = 0.1, (0.5, 0.4), 50.0


class DynamicFramePublisher(Node):
    def __init__(self):
        super().__init__("dynamic_tf_broadcaster")
        self.broadcaster = TransformBroadcaster(self)
        self.create_subscription(JointState, "/joint_states", self.follow, 10)
        self.create_timer(1.0 / RATE, self.simulate)
        self.start = None
        self.followed = False

    def simulate(self):
        if self.followed:
            return
        now = self.get_clock().now()
        self.start = self.start or now
        t = (now - self.start).nanoseconds / 1e9
        q1 = 0.5 * math.sin(2 * math.pi * 0.2 * t)
        q2 = 0.3 * math.sin(2 * math.pi * 0.3 * t + math.pi / 4)
        self.publish_arm(q1, q2)

    def follow(self, message):
        self.followed = True
        angles = dict(zip(message.name, message.position))
        self.publish_arm(angles["joint1"], angles["joint2"])

    def publish_arm(self, q1, q2):
        stamp = self.get_clock().now().to_msg()
        self.broadcaster.sendTransform(
            [
                self.make(stamp, "base_link", "link1", (0.0, 0.0, HEIGHT), q1),
                self.make(stamp, "link1", "link2", (LENGTHS[0], 0.0, 0.0), q2),
                self.make(stamp, "link2", "end_effector", (LENGTHS[1], 0.0, 0.0), 0.0),
            ]
        )

    def make(self, stamp, parent, child, position, yaw):
        t = TransformStamped()
        t.header.stamp = stamp
        t.header.frame_id = parent
        t.child_frame_id = child
        t.transform.translation.x, t.transform.translation.y, t.transform.translation.z = position
        t.transform.rotation.z = math.sin(yaw / 2)
        t.transform.rotation.w = math.cos(yaw / 2)
        return t


def main():
    rclpy.init()
    node = DynamicFramePublisher()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
