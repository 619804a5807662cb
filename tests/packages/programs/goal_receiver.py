# SPDX-License-Identifier: Apache-2.0
"""Receives what yaml_publisher publishes."""

import math

import rclpy
from geometry_msgs.msg import PoseStamped
from tf_transformations import euler_from_quaternion

rclpy.init()
node = rclpy.create_node("goal_receiver")
goals = []
node.create_subscription(PoseStamped, "goal_pose", goals.append, 10)
while not goals:
    rclpy.spin_once(node)
q = goals[0].pose.orientation
yaw = euler_from_quaternion((q.x, q.y, q.z, q.w))[2]
print(
    "goal", goals[0].header.frame_id, goals[0].pose.position.x, round(math.degrees(yaw)), goals[0].header.stamp.sec > 0
)
rclpy.shutdown()
