# SPDX-License-Identifier: Apache-2.0
"""A client that calls services in random order, and prints how many replies were right, wrong and missing.

Arguments: the number of calls, a number that no other client has, and the names of the services.
"""

import random
import sys

import rclpy
from example_interfaces.srv import AddTwoInts

calls, number = map(int, sys.argv[1:3])
rclpy.init()
node = rclpy.create_node(f"client{number}")
clients = [node.create_client(AddTwoInts, name) for name in sys.argv[3:]]
for client in clients:
    assert client.wait_for_service(20.0), client.srv_name
    # As in ROS 2, the first request can be lost: on a busy machine, the server discovers the client long after that.
    for _ in range(10):
        future = client.call_async(AddTwoInts.Request())
        rclpy.spin_until_future_complete(node, future, timeout_sec=2.0)
        if future.done():
            break
print("ready", flush=True)
sys.stdin.readline()
counts = {"right": 0, "wrong": 0, "missing": 0}
for call in range(calls):
    request = AddTwoInts.Request(a=number << 40, b=call)
    future = random.choice(clients).call_async(request)
    rclpy.spin_until_future_complete(node, future, timeout_sec=10.0)
    result = future.result() if future.done() else None
    counts["missing" if result is None else "right" if result.sum == request.a + request.b else "wrong"] += 1
print(counts["right"], counts["wrong"], counts["missing"], flush=True)
