# SPDX-License-Identifier: Apache-2.0
"""A node that publishes a string on the topic chatter every second."""

from __future__ import annotations

from coframe.nodes.program import program, spin_until_shutdown
from rclpy.node import Node
from std_msgs.msg import String

__all__ = ["Talker", "main"]


class Talker(Node):
    """Publishes "Hello World: N" on chatter every second."""

    def __init__(self) -> None:
        super().__init__("talker")
        self.__number = 0
        self.__publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(1.0, self.__publish)

    def __publish(self) -> None:
        self.__number += 1
        message = String(data=f"Hello World: {self.__number}")
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.__publisher.publish(message)


def main(args: list[str] | None = None) -> None:
    """Run the node until shutdown."""
    program("talker", args, lambda words, _: spin_until_shutdown(Talker, words, None))


if __name__ == "__main__":
    main()
