# SPDX-License-Identifier: Apache-2.0
"""A node that publishes the pose of a turtle as a transform from ``world``."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from coframe.nodes.program import program, spin_until_shutdown
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from turtle_tf2_py._interfaces import Pose

if TYPE_CHECKING:
    from typing import Any

__all__ = ["FramePublisher", "main"]


class FramePublisher(Node):
    """Publishes the transform of the turtle whose name is the parameter ``turtlename``."""

    def __init__(self) -> None:
        super().__init__("turtle_tf2_frame_publisher")
        self.turtlename: str = self.declare_parameter("turtlename", "turtle").get_parameter_value().string_value
        self.tf_broadcaster = TransformBroadcaster(self)
        self.create_subscription(Pose, f"/{self.turtlename}/pose", self.handle_turtle_pose, 1)

    def handle_turtle_pose(self, msg: Any) -> None:
        """Publish the transform of a pose."""
        transform = TransformStamped()
        transform.header.stamp = self.get_clock().now().to_msg()
        transform.header.frame_id = "world"
        transform.child_frame_id = self.turtlename
        transform.transform.translation.x, transform.transform.translation.y = msg.x, msg.y
        transform.transform.rotation.z = math.sin(msg.theta / 2)
        transform.transform.rotation.w = math.cos(msg.theta / 2)
        self.tf_broadcaster.sendTransform(transform)


def main(args: list[str] | None = None) -> None:
    """Run the node until shutdown."""
    program("turtle_tf2_broadcaster", args, lambda words, _: spin_until_shutdown(FramePublisher, words, None))


if __name__ == "__main__":
    main()
