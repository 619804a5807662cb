# SPDX-License-Identifier: Apache-2.0
"""A node that publishes a static transform from ``world``, which its arguments describe."""

from __future__ import annotations

import sys

from coframe.nodes.program import program, spin_until_shutdown
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import StaticTransformBroadcaster
from tf_transformations import quaternion_from_euler

__all__ = ["StaticFramePublisher", "main"]

_USAGE = "Usage: ros2 run turtle_tf2_py static_turtle_tf2_broadcaster child_frame_name x y z roll pitch yaw"


class StaticFramePublisher(Node):
    """Publishes the transform once, for all later subscribers too.

    Args:
        child: Name of the child frame.
        values: x, y, z in meters; roll, pitch, yaw in radians.
    """

    def __init__(self, child: str, values: list[float]) -> None:
        super().__init__("static_turtle_tf2_broadcaster")
        self.tf_static_broadcaster = StaticTransformBroadcaster(self)
        transform = TransformStamped()
        transform.header.stamp = self.get_clock().now().to_msg()
        transform.header.frame_id = "world"
        transform.child_frame_id = child
        translation, rotation = transform.transform.translation, transform.transform.rotation
        translation.x, translation.y, translation.z = values[:3]
        rotation.x, rotation.y, rotation.z, rotation.w = map(
            float, quaternion_from_euler(values[3], values[4], values[5])
        )
        self.tf_static_broadcaster.sendTransform(transform)


def main(args: list[str] | None = None) -> None:
    """Run the node until shutdown."""
    program("static_turtle_tf2_broadcaster", args, _run)


def _run(words: list[str], arguments: list[str]) -> None:
    if len(arguments) != 7:
        sys.exit(f"Invalid number of parameters.\n{_USAGE}")
    child, *texts = arguments
    if child == "world":
        sys.exit('Your static turtle name cannot be "world"')
    try:
        values = [float(text) for text in texts]
    except ValueError:
        sys.exit(f"x, y, z, roll, pitch and yaw must be numbers, not {' '.join(texts)}.\n{_USAGE}")
    spin_until_shutdown(lambda: StaticFramePublisher(child, values), words, None)


if __name__ == "__main__":
    main()
