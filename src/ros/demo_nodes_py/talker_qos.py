# SPDX-License-Identifier: Apache-2.0
"""A node that publishes a string on the topic chatter every second, reliable or best effort."""

from __future__ import annotations

from typing import TYPE_CHECKING

from demo_nodes_py._qos_options import is_reliable, run
from rclpy.node import Node
from std_msgs.msg import String

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile

__all__ = ["TalkerQos", "main"]


class TalkerQos(Node):
    """Publishes "Hello World: N" on chatter every second.

    Args:
        qos_profile: The quality of service.
    """

    def __init__(self, qos_profile: QoSProfile) -> None:
        super().__init__("talker_qos")
        self.__number = 0
        self.get_logger().info("Reliable talker" if is_reliable(qos_profile) else "Best effort talker")
        self.__publisher = self.create_publisher(String, "chatter", qos_profile)
        self.create_timer(1.0, self.__publish)

    def __publish(self) -> None:
        message = String(data=f"Hello World: {self.__number}")
        self.__number += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.__publisher.publish(message)


def main(args: list[str] | None = None) -> None:
    """Run the node for a number of cycles."""
    run("talker_qos", TalkerQos, args)


if __name__ == "__main__":
    main()
