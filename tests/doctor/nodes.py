# SPDX-License-Identifier: Apache-2.0
"""The source code of nodes that tests run as processes."""

# The body of NODE can use `node`, `every(period, call)` and `stamped(parent, child, x)`.
NODE = """
import sys, rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformException, TransformListener

rclpy.init()
node = Node(sys.argv[1])

def stamped(parent, child, x=0.0, stamp=None):
    t = TransformStamped()
    t.header.stamp = (stamp or node.get_clock().now()).to_msg()
    t.header.frame_id, t.child_frame_id = parent, child
    t.transform.translation.x, t.transform.rotation.w = x, 1.0
    return t

def every(period, call):
    node.create_timer(period, call)

{body}
rclpy.spin(node)
"""
ROBOT = """
broadcaster, statics = TransformBroadcaster(node), StaticTransformBroadcaster(node)
statics.sendTransform(stamped("base_link", "lidar_link", 0.1))
begun = node.get_clock().now()
def move():
    now = node.get_clock().now()
    broadcaster.sendTransform(stamped("odom", "base_link", (now - begun).nanoseconds * 1e-10, now))
every(0.02, move)
"""
