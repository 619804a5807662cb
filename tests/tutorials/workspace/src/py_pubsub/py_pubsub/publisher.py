# SPDX-License-Identifier: Apache-2.0
"""Publishes numbers and spheres twenty times a second."""

import rclpy
from geometry_msgs.msg import Point
from rclpy.node import Node
from tutorial_interfaces.msg import Num, Sphere


class Publisher(Node):
    def __init__(self):
        super().__init__("minimal_publisher")
        self.numbers = self.create_publisher(Num, "topic", 10)
        self.spheres = self.create_publisher(Sphere, "spheres", 10)
        self.timer = self.create_timer(0.05, self.publish)
        self.i = 0

    def publish(self):
        msg = Num()
        msg.num = self.i
        self.numbers.publish(msg)
        self.spheres.publish(Sphere(center=Point(x=float(self.i)), radius=0.5))
        self.i += 1


def main(args=None):
    rclpy.init(args=args)
    node = Publisher()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.try_shutdown()
