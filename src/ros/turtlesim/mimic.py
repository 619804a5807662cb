# SPDX-License-Identifier: Apache-2.0
"""A node that makes one turtle move like another: remap ``input/pose`` and ``output/cmd_vel``."""

from __future__ import annotations

from coframe.nodes.program import program, spin_until_shutdown
from geometry_msgs.msg import Twist
from rclpy.node import Node
from turtlesim._interfaces import Pose

__all__ = ["Mimic", "main"]


class Mimic(Node):
    """Publishes the velocity of one turtle as the command of another."""

    def __init__(self) -> None:
        super().__init__("turtle_mimic")
        self.__commands = self.create_publisher(Twist, "output/cmd_vel", 1)
        self.create_subscription(Pose, "input/pose", self.__on_pose, 1)

    def __on_pose(self, pose: Pose) -> None:
        command = Twist()
        command.linear.x, command.angular.z = pose.linear_velocity, pose.angular_velocity
        self.__commands.publish(command)


def main(args: list[str] | None = None) -> None:
    """Run the console script."""
    program("mimic", args, lambda words, _: spin_until_shutdown(Mimic, words, None))


if __name__ == "__main__":
    main()
