# SPDX-License-Identifier: Apache-2.0
"""Adds three integers."""

import rclpy
from rclpy.node import Node
from tutorial_interfaces.srv import AddThreeInts


class Service(Node):
    def __init__(self):
        super().__init__("minimal_service")
        self.srv = self.create_service(AddThreeInts, "add_three_ints", self.add)

    def add(self, request, response):
        response.sum = request.a + request.b + request.c
        self.get_logger().info("Incoming request\na: %d b: %d c: %d" % (request.a, request.b, request.c))
        return response


def main():
    rclpy.init()
    try:
        rclpy.spin(Service())
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
