# SPDX-License-Identifier: Apache-2.0
"""A node that publishes odom -> base at 50 Hz and base -> lidar once, written for ROS 2."""

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

rclpy.init()
node = Node("talker")


def transform(parent, child, x):
    result = TransformStamped()
    result.header.stamp = node.get_clock().now().to_msg()
    result.header.frame_id, result.child_frame_id = parent, child
    result.transform.translation.x = x
    return result


StaticTransformBroadcaster(node).sendTransform(transform("base", "lidar", 2.0))
broadcaster = TransformBroadcaster(node)
node.create_timer(0.02, lambda: broadcaster.sendTransform(transform("odom", "base", 1.0)))
print("talking", flush=True)
rclpy.spin(node)
