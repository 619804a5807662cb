# SPDX-License-Identifier: Apache-2.0
"""A node that makes a second turtle follow the frame ``target_frame``."""

from __future__ import annotations

import math
from typing import Any

from coframe.nodes.program import program, spin_until_shutdown
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener
from turtle_tf2_py._interfaces import Spawn

__all__ = ["FrameListener", "main"]

_FOLLOWER = "turtle2"
_TURN, _SPEED = 1.0, 0.5  # gains


class FrameListener(Node):
    """Spawns ``turtle2`` and drives it towards the frame that the parameter ``target_frame`` names."""

    def __init__(self) -> None:
        super().__init__("turtle_tf2_frame_listener")
        self.target_frame: str = self.declare_parameter("target_frame", "turtle1").get_parameter_value().string_value
        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        self.__spawner = self.create_client(Spawn, "spawn")
        self.__spawning: Any = None
        self.__publisher = self.create_publisher(Twist, f"{_FOLLOWER}/cmd_vel", 1)
        self.create_timer(1.0, self.__spawn)
        self.create_timer(0.1, self.__follow)

    def __spawn(self) -> None:
        if self.__spawning is None and self.__spawner.service_is_ready():
            request = Spawn.Request(name=_FOLLOWER, x=4.0, y=2.0, theta=0.0)
            self.__spawning = self.__spawner.call_async(request)
            self.__spawning.add_done_callback(
                lambda future: self.get_logger().info(f"Successfully spawned {future.result().name}")
            )

    def __follow(self) -> None:
        if self.__spawning is None or not self.__spawning.done():
            return
        try:
            found = self.tf_buffer.lookup_transform(_FOLLOWER, self.target_frame, Time())
        except TransformException as error:
            self.get_logger().info(f"Could not transform {_FOLLOWER} to {self.target_frame}: {error}")
            return
        x, y = found.transform.translation.x, found.transform.translation.y
        command = Twist()
        command.angular.z, command.linear.x = _TURN * math.atan2(y, x), _SPEED * math.hypot(x, y)
        self.__publisher.publish(command)


def main(args: list[str] | None = None) -> None:
    """Run the node until shutdown."""
    program("turtle_tf2_listener", args, lambda words, _: spin_until_shutdown(FrameListener, words, None))


if __name__ == "__main__":
    main()
