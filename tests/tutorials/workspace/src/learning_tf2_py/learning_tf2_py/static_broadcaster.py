# SPDX-License-Identifier: Apache-2.0
"""Publishes the static transform on the command line."""

import sys

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster


class StaticFramePublisher(Node):
    def __init__(self, arguments):
        super().__init__("static_turtle_tf2_broadcaster")
        self.tf_static_broadcaster = StaticTransformBroadcaster(self)
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = "world"
        t.child_frame_id = arguments[1]
        t.transform.translation.x = float(arguments[2])
        t.transform.translation.y = float(arguments[3])
        t.transform.translation.z = float(arguments[4])
        self.tf_static_broadcaster.sendTransform(t)


def main():
    rclpy.init()
    try:
        rclpy.spin(StaticFramePublisher(sys.argv))
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
