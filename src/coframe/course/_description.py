# SPDX-License-Identifier: Apache-2.0
"""A node that publishes only the description of the lab's arm, without transforms.

The doctor compares the transforms of other nodes with it.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import rclpy
from coframe.errors import CoframeError
from coframe.lab.robot_state_publisher import ARM
from coframe.robots import load
from rclpy.executors import ExternalShutdownException
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ["main"]

_LIDAR = "0 0 0.5"  # as mounted by static_tf_broadcaster


def _publish(node: Node) -> None:
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    text = load(ARM, arguments={"lidar_xyz": _LIDAR}).text
    node.create_publisher(String, "/robot_description", latched).publish(String(data=text))


def main() -> None:
    """Run the node until it is interrupted."""
    rclpy.init()
    node = rclpy.create_node("robot_description")
    try:
        _publish(node)
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except CoframeError as error:
        sys.exit(str(error))
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
