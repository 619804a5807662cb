# SPDX-License-Identifier: Apache-2.0
"""Turns towards a goal: the smaller of both rotations, from exactly synchronized odometry and IMU data."""

import math

import angles
import rclpy
from geometry_msgs.msg import Twist
from message_filters import Subscriber, TimeSynchronizer
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import Imu
from tf_transformations import euler_from_quaternion


class HeadingController(Node):
    def __init__(self):
        super().__init__("heading_controller")
        self.goal = self.declare_parameter("goal", 3.0).value
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.subs = [Subscriber(self, Odometry, "odom"), Subscriber(self, Imu, "imu")]
        self.sync = TimeSynchronizer(self.subs, 5)
        self.sync.registerCallback(self.control, "extra")
        self.commands = 0

    def control(self, odom, imu, extra):
        q = odom.pose.pose.orientation
        roll, pitch, yaw = euler_from_quaternion([q.x, q.y, q.z, q.w])
        error = angles.shortest_angular_distance(yaw, self.goal)
        command = Twist()
        command.angular.z = max(-1.0, min(1.0, 2.0 * error - imu.angular_velocity.z))
        self.publisher.publish(command)
        self.commands += 1
        if self.commands == 3:
            ok = abs(error) <= math.pi and odom.header.stamp == imu.header.stamp
            print("heading", ok, extra, roll == pitch == 0.0)


rclpy.init()
node = HeadingController()
while node.commands < 3:
    rclpy.spin_once(node)
node.destroy_node()
rclpy.shutdown()
