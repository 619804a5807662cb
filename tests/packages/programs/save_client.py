# SPDX-License-Identifier: Apache-2.0
"""Calls the service of image_saver until an image was saved."""

import sys

import cv2

import rclpy
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("save_client")
client = node.create_client(Trigger, "/image_saver/save")
while not client.wait_for_service(timeout_sec=1.0):
    node.get_logger().info("waiting")
response = Trigger.Response()
while not response.success:
    future = client.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future, timeout_sec=5.0)
    response = future.result()
print("saved", cv2.imread(response.message).shape, file=sys.stdout)
node.destroy_node()
rclpy.shutdown()
