# SPDX-License-Identifier: Apache-2.0
"""A node that logs the strings on the topic chatter, reliable or best effort."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.escaping import printable
from demo_nodes_py._qos_options import is_reliable, run
from rclpy.node import Node
from std_msgs.msg import String

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile

__all__ = ["ListenerQos", "main"]


class ListenerQos(Node):
    """Logs "I heard: [TEXT]" for each message on chatter.

    Args:
        qos_profile: The quality of service.
    """

    def __init__(self, qos_profile: QoSProfile) -> None:
        super().__init__("listener_qos")
        self.get_logger().info("Reliable listener" if is_reliable(qos_profile) else "Best effort listener")
        self.create_subscription(String, "chatter", self.__log, qos_profile)

    def __log(self, message: String) -> None:
        self.get_logger().info(f"I heard: [{printable(message.data)}]")


def main(args: list[str] | None = None) -> None:
    """Run the node for a number of cycles."""
    run("listener_qos", ListenerQos, args)


if __name__ == "__main__":
    main()
