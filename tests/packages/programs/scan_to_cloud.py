# SPDX-License-Identifier: Apache-2.0
"""Publishes a laser scan as a cloud in the odometry frame."""

import rclpy
from laser_geometry import LaserProjection
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import LaserScan, PointCloud2
from sensor_msgs_py.point_cloud2 import read_points_list
from tf2_ros import Buffer, TransformException, TransformListener
from tf2_sensor_msgs.tf2_sensor_msgs import do_transform_cloud


class ScanToCloud(Node):
    def __init__(self):
        super().__init__("scan_to_cloud")
        self.projector = LaserProjection()
        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self, spin_thread=True)
        self.publisher = self.create_publisher(PointCloud2, "scan_cloud", 1)
        self.subscription = self.create_subscription(LaserScan, "scan", self.scan_callback, 10)
        self.done = False

    def scan_callback(self, scan):
        cloud = self.projector.projectLaser(scan)
        try:
            transform = self.tf_buffer.lookup_transform(
                "odom", scan.header.frame_id, Time.from_msg(scan.header.stamp), timeout=Duration(seconds=1.0)
            )
        except TransformException as ex:
            self.get_logger().info(f"Could not transform: {ex}")
            return
        cloud = do_transform_cloud(cloud, transform)
        self.publisher.publish(cloud)
        points = read_points_list(cloud, field_names=["x", "y", "z"])
        print("scan", cloud.header.frame_id, len(points), round(points[0].z, 3))
        self.done = True


rclpy.init()
node = ScanToCloud()
while not node.done:
    rclpy.spin_once(node)
rclpy.shutdown()
