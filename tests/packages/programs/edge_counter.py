# SPDX-License-Identifier: Apache-2.0
"""Compares the pixels of raw and compressed edges."""

import numpy as np

import rclpy
from cv_bridge import CvBridge
from rclpy.node import Node
from sensor_msgs.msg import CompressedImage, Image


class EdgeCounter(Node):
    def __init__(self):
        super().__init__("edge_counter")
        self.bridge = CvBridge()
        self.raw = self.packed = None
        self.create_subscription(Image, "edges", self.on_raw, 10)
        self.create_subscription(CompressedImage, "edges/compressed", self.on_compressed, 10)

    def on_raw(self, msg):
        self.raw = int(np.count_nonzero(self.bridge.imgmsg_to_cv2(msg)))

    def on_compressed(self, msg):
        self.packed = int(np.count_nonzero(self.bridge.compressed_imgmsg_to_cv2(msg)))


rclpy.init()
counter = EdgeCounter()
while rclpy.ok() and (counter.raw is None or counter.packed is None):
    rclpy.spin_once(counter, timeout_sec=0.1)
print("edges", 60 <= counter.raw <= 100, counter.raw == counter.packed)
counter.destroy_node()
rclpy.shutdown()
