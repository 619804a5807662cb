# SPDX-License-Identifier: Apache-2.0
"""Inflates the obstacles of a map."""

import cv2
import numpy as np

import rclpy
import ros2_numpy
from nav_msgs.msg import OccupancyGrid
from rclpy.qos import DurabilityPolicy, QoSProfile

rclpy.init()
node = rclpy.create_node("map_inflater")
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
publisher = node.create_publisher(OccupancyGrid, "inflated_map", latched)
finished = rclpy.task.Future()


def callback(msg):
    grid = ros2_numpy.numpify(msg)
    obstacles = (grid.filled(0) > 50).astype(np.uint8)
    inflated = cv2.dilate(obstacles, np.ones((3, 3), np.uint8)) * 100
    publisher.publish(ros2_numpy.msgify(OccupancyGrid, inflated.astype(np.int8), info=msg.info))
    print("map", grid.shape, int((inflated == 100).sum()), round(msg.info.resolution, 2))
    finished.set_result(True)


node.create_subscription(OccupancyGrid, "map", callback, latched)
rclpy.spin_until_future_complete(node, finished)
rclpy.shutdown()
