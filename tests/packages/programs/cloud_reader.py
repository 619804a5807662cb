# SPDX-License-Identifier: Apache-2.0
"""Reads a colored cloud in three ways."""

import numpy as np

import rclpy
import ros2_numpy
from rclpy.node import Node
from sensor_msgs.msg import PointCloud2
from sensor_msgs_py import point_cloud2


class CloudReader(Node):
    def __init__(self):
        super().__init__("cloud_reader")
        self.sub = self.create_subscription(PointCloud2, "points", self.callback, 10)

    def callback(self, msg):
        points = point_cloud2.read_points_numpy(msg, field_names=("x", "y", "z"), skip_nans=True)
        same = np.array_equal(ros2_numpy.point_cloud2.pointcloud2_to_xyz_array(msg), points)
        colors = ros2_numpy.point_cloud2.split_rgb_field(ros2_numpy.numpify(msg))
        red = colors[colors["r"] > 200]
        print("cloud", (msg.height, msg.width), points.shape, same, np.unique(points[:, 2]), len(red))
        raise SystemExit


rclpy.init()
try:
    rclpy.spin(CloudReader())
except SystemExit:
    rclpy.shutdown()
