# SPDX-License-Identifier: Apache-2.0
"""Prints numbers and spheres."""

import rclpy
from rclpy.node import Node
from tutorial_interfaces.msg import Num, Sphere


class Subscriber(Node):
    def __init__(self):
        super().__init__("minimal_subscriber")
        self.create_subscription(Num, "topic", self.number, 10)
        self.create_subscription(Sphere, "spheres", self.sphere, 10)

    def number(self, msg):
        self.get_logger().info('I got: "%d"' % msg.num)

    def sphere(self, msg):
        self.get_logger().info(f"center {msg.center.x} radius {msg.radius}")


def main(args=None):
    rclpy.init(args=args)
    node = Subscriber()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.try_shutdown()
