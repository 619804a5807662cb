# SPDX-License-Identifier: Apache-2.0
"""Extension 2: where the end effector was one second ago."""

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener


class TimeTravel(Node):
    def __init__(self):
        super().__init__("time_travel")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(PoseStamped, "/past_end_effector_pose", 10)
        self.create_timer(0.1, self.publish)

    def publish(self):
        try:
            newest = self.buffer.lookup_transform("odom", "end_effector", Time())
            present = Time.from_msg(newest.header.stamp)
            past = present - Duration(seconds=1)
            transform = self.buffer.lookup_transform_full("base_link", present, "end_effector", past, "odom")
        except TransformException:
            return
        pose = PoseStamped()
        pose.header.frame_id = "base_link"
        pose.header.stamp = present.to_msg()
        moved = transform.transform.translation
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = moved.x, moved.y, moved.z
        pose.pose.orientation = transform.transform.rotation
        self.publisher.publish(pose)


rclpy.init()
try:
    rclpy.spin(TimeTravel())
except KeyboardInterrupt:
    pass
