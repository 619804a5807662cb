# SPDX-License-Identifier: Apache-2.0
"""A service that adds, until its standard input ends. Its arguments are the names of the service."""

import sys
import threading

import rclpy
from example_interfaces.srv import AddTwoInts


def add(request, response):
    response.sum = request.a + request.b
    return response


def wait_for_end() -> None:
    sys.stdin.read()
    rclpy.shutdown()


rclpy.init()
node = rclpy.create_node("server")
for name in sys.argv[1:]:
    node.create_service(AddTwoInts, name, add)
threading.Thread(target=wait_for_end, daemon=True).start()
print("ready", flush=True)
rclpy.spin(node)
