# SPDX-License-Identifier: Apache-2.0
"""Saves the last image when its service is called."""

import sys

import cv2

import rclpy
from cv_bridge import CvBridge
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image
from std_srvs.srv import Trigger


class ImageSaver(Node):
    def __init__(self):
        super().__init__("image_saver")
        self.declare_parameter("filename", "image.png")
        self.last = None
        group = ReentrantCallbackGroup()
        self.create_subscription(Image, "left/image_raw", self.remember, qos_profile_sensor_data, callback_group=group)
        self.create_service(Trigger, "~/save", self.save, callback_group=group)

    def remember(self, msg):
        self.last = CvBridge().imgmsg_to_cv2(msg, "bgr8")

    def save(self, request, response):
        if self.last is None:
            response.message = "no image yet"
            return response
        response.message = self.get_parameter("filename").get_parameter_value().string_value
        response.success = cv2.imwrite(response.message, self.last)
        return response


def main():
    rclpy.init(args=sys.argv)
    node = ImageSaver()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    try:
        executor.spin()
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
