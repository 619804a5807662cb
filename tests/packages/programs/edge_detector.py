# SPDX-License-Identifier: Apache-2.0
"""Publishes the edges of an image, also as PNG."""

import cv2

import rclpy
from cv_bridge import CvBridge, CvBridgeError
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CompressedImage, Image


class EdgeDetector(Node):
    def __init__(self):
        super().__init__("edge_detector")
        self.bridge = CvBridge()
        self.publisher = self.create_publisher(Image, "edges", 10)
        self.compressed = self.create_publisher(CompressedImage, "edges/compressed", 10)
        self.create_subscription(Image, "left/image_raw", self.callback, qos_profile_sensor_data)

    def callback(self, msg):
        try:
            gray = self.bridge.imgmsg_to_cv2(msg, desired_encoding="mono8")
        except CvBridgeError as e:
            self.get_logger().error(str(e))
            return
        edges = cv2.Canny(gray, 10, 50)
        self.publisher.publish(self.bridge.cv2_to_imgmsg(edges, encoding="mono8", header=msg.header))
        self.compressed.publish(self.bridge.cv2_to_compressed_imgmsg(edges, dst_format="png"))


def main():
    rclpy.init()
    node = EdgeDetector()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()


main()
