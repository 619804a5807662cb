# SPDX-License-Identifier: Apache-2.0
"""A robot that drives a circle, with odometry, an IMU, a laser scanner and a map."""

import math

import numpy as np

import rclpy
import ros2_numpy
from geometry_msgs.msg import Quaternion, TransformStamped
from nav_msgs.msg import MapMetaData, OccupancyGrid, Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import Imu, LaserScan
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster
from tf_transformations import quaternion_from_euler


class RobotSimulator(Node):
    def __init__(self):
        super().__init__("robot_simulator")
        self.start = self.get_clock().now()
        self.odom_pub = self.create_publisher(Odometry, "odom", 10)
        self.imu_pub = self.create_publisher(Imu, "imu", 10)
        self.scan_pub = self.create_publisher(LaserScan, "scan", 10)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.map_pub = self.create_publisher(OccupancyGrid, "map", latched)
        cells = np.zeros((20, 30), np.int8)
        cells[10, 5] = 100
        self.map_pub.publish(ros2_numpy.msgify(OccupancyGrid, cells, info=MapMetaData(resolution=0.1)))
        self.broadcaster = TransformBroadcaster(self)
        self.static_broadcaster = StaticTransformBroadcaster(self)
        laser = TransformStamped(child_frame_id="laser")
        laser.header.frame_id, laser.header.stamp = "base_link", self.start.to_msg()
        laser.transform.translation.z = 0.5
        self.static_broadcaster.sendTransform(laser)
        self.create_timer(0.05, self.step)

    def step(self):
        now = self.get_clock().now()
        yaw = 0.5 * (now - self.start).nanoseconds * 1e-9
        x, y, z, w = quaternion_from_euler(0.0, 0.0, yaw)
        t = TransformStamped(child_frame_id="base_link")
        t.header.stamp, t.header.frame_id = now.to_msg(), "odom"
        t.transform.translation.x, t.transform.translation.y = math.sin(yaw), 1.0 - math.cos(yaw)
        t.transform.rotation = Quaternion(x=x, y=y, z=z, w=w)
        self.broadcaster.sendTransform(t)
        odom = Odometry(header=t.header, child_frame_id="base_link")
        odom.pose.pose.position.x, odom.pose.pose.position.y = t.transform.translation.x, t.transform.translation.y
        odom.pose.pose.orientation = t.transform.rotation
        odom.twist.twist.linear.x = odom.twist.twist.angular.z = 0.5
        self.odom_pub.publish(odom)
        imu = Imu(orientation=t.transform.rotation)
        imu.header.stamp, imu.header.frame_id = now.to_msg(), "base_link"
        imu.angular_velocity.z = 0.5
        self.imu_pub.publish(imu)
        scan = LaserScan(angle_min=-math.pi / 2, angle_max=math.pi / 2, angle_increment=math.pi / 180)
        scan.header.stamp, scan.header.frame_id = now.to_msg(), "laser"
        scan.range_min, scan.range_max = 0.1, 10.0
        scan.ranges = [math.inf] * 60 + [3.0] * 61 + [math.inf] * 60
        self.scan_pub.publish(scan)


def main():
    rclpy.init()
    try:
        rclpy.spin(RobotSimulator())
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
