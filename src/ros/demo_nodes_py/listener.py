# SPDX-License-Identifier: Apache-2.0
"""A node that logs the strings on the topic chatter."""

from __future__ import annotations

from coframe._output.escaping import printable
from coframe.nodes.program import program, spin_until_shutdown
from rclpy.node import Node
from std_msgs.msg import String

__all__ = ["Listener", "main"]


class Listener(Node):
    """Logs "I heard: [TEXT]" for each message on chatter."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.create_subscription(String, "chatter", self.__log, 10)

    def __log(self, message: String) -> None:
        self.get_logger().info(f"I heard: [{printable(message.data)}]")


def main(args: list[str] | None = None) -> None:
    """Run the node until shutdown."""
    program("listener", args, lambda words, _: spin_until_shutdown(Listener, words, None))


if __name__ == "__main__":
    main()
