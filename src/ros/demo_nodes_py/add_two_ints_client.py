# SPDX-License-Identifier: Apache-2.0
"""A node that calls the service add_two_ints once."""

from __future__ import annotations

import rclpy
from coframe.nodes.program import initialize_rclpy, program
from example_interfaces.srv import AddTwoInts

__all__ = ["main"]


def main(args: list[str] | None = None) -> None:
    """Call the service, log the sum and exit."""
    program("add_two_ints_client", args, lambda words, _: _call(words))


def _call(words: list[str]) -> None:
    with initialize_rclpy(words, None):
        node = rclpy.create_node("add_two_ints_client")
        client = node.create_client(AddTwoInts, "add_two_ints")
        while not client.wait_for_service(timeout_sec=1.0):
            node.get_logger().info("service not available, waiting again...")
        future = client.call_async(AddTwoInts.Request(a=2, b=3))
        rclpy.spin_until_future_complete(node, future)
        response = future.result()
        assert response is not None
        node.get_logger().info(f"Result of add_two_ints: {response.sum}")
        node.destroy_node()


if __name__ == "__main__":
    main()
