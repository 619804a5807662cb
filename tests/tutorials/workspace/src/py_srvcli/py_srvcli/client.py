# SPDX-License-Identifier: Apache-2.0
"""Asks for the sum of the three integers on the command line."""

import sys

import rclpy
from rclpy.node import Node
from tutorial_interfaces.srv import AddThreeInts


class Client(Node):
    def __init__(self):
        super().__init__("minimal_client_async")
        self.cli = self.create_client(AddThreeInts, "add_three_ints")
        while not self.cli.wait_for_service(timeout_sec=1.0):
            self.get_logger().info("service not available, waiting again...")
        self.req = AddThreeInts.Request()

    def send_request(self, a, b, c):
        self.req.a, self.req.b, self.req.c = a, b, c
        self.future = self.cli.call_async(self.req)
        rclpy.spin_until_future_complete(self, self.future)
        return self.future.result()


def main():
    rclpy.init()
    node = Client()
    numbers = [int(word) for word in sys.argv[1:4]]
    response = node.send_request(*numbers)
    node.get_logger().info(f"Result: {response.sum}")
    node.destroy_node()
    rclpy.shutdown()
