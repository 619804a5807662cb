# SPDX-License-Identifier: Apache-2.0
"""A node with the service add_two_ints."""

from __future__ import annotations

from typing import Any

from coframe.nodes.program import program, spin_until_shutdown
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node

__all__ = ["AddTwoIntsServer", "main"]


class AddTwoIntsServer(Node):
    """Responds with the sum of two numbers."""

    def __init__(self) -> None:
        super().__init__("add_two_ints_server")
        self.create_service(AddTwoInts, "add_two_ints", self.__add)

    def __add(self, request: Any, response: Any) -> Any:
        response.sum = request.a + request.b
        self.get_logger().info(f"Incoming request\na: {request.a} b: {request.b}")
        return response


def main(args: list[str] | None = None) -> None:
    """Run the node until shutdown."""
    program("add_two_ints_server", args, lambda words, _: spin_until_shutdown(AddTwoIntsServer, words, None))


if __name__ == "__main__":
    main()
