# SPDX-License-Identifier: Apache-2.0
"""Extension 4: a monitor of transforms."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage


class Monitor(Node):
    def __init__(self):
        super().__init__("tf_monitor")
        self.publisher = self.create_publisher(String, "/tf_problems", 10)
        self.create_subscription(TFMessage, "/tf", self.receive, 100)
        self.create_timer(0.5, self.find_stale)
        self.newest = {}
        self.parents = {}

    def receive(self, message):
        for each in message.transforms:
            child, parent = each.child_frame_id, each.header.frame_id
            self.newest[child] = self.get_clock().now()
            if self.parents.setdefault(child, parent) != parent:
                self.report(f"{child} has two parents: {self.parents[child]} and {parent}")

    def find_stale(self):
        now = self.get_clock().now()
        for child, time in self.newest.items():
            age = (now - time).nanoseconds / 1e9
            if age > 1.0:
                self.report(f"{child} was not published for {age:.1f} s")

    def report(self, text):
        self.publisher.publish(String(data=text))


rclpy.init()
try:
    rclpy.spin(Monitor())
except KeyboardInterrupt:
    pass
