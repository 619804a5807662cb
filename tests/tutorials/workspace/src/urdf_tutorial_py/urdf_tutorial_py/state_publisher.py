# SPDX-License-Identifier: Apache-2.0
"""Moves a robot in a circle, in a loop with a rate."""

import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from sensor_msgs.msg import JointState
from tf2_ros import TransformBroadcaster


class StatePublisher(Node):
    def __init__(self):
        rclpy.init()
        super().__init__("state_publisher")
        self.joint_pub = self.create_publisher(JointState, "joint_states", 10)
        self.broadcaster = TransformBroadcaster(self, qos=10)
        loop_rate = self.create_rate(30)
        angle = 0.0
        odom_trans = TransformStamped()
        odom_trans.header.frame_id = "odom"
        odom_trans.child_frame_id = "axis"
        joint_state = JointState()
        try:
            while rclpy.ok():
                rclpy.spin_once(self)
                now = self.get_clock().now()
                joint_state.header.stamp = now.to_msg()
                joint_state.name = ["swivel"]
                joint_state.position = [angle]
                odom_trans.header.stamp = now.to_msg()
                odom_trans.transform.translation.x = math.cos(angle) * 2
                odom_trans.transform.translation.y = math.sin(angle) * 2
                odom_trans.transform.translation.z = 0.7
                self.joint_pub.publish(joint_state)
                self.broadcaster.sendTransform(odom_trans)
                angle += math.radians(1)
                loop_rate.sleep()
        except KeyboardInterrupt:
            pass


def main():
    StatePublisher()
