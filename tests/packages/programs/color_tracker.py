# SPDX-License-Identifier: Apache-2.0
"""Finds the largest red object and publishes the ray to it."""

import cv2

import message_filters
import rclpy
from cv_bridge import CvBridge
from geometry_msgs.msg import Vector3Stamped
from image_geometry import PinholeCameraModel
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, Image


class ColorTracker(Node):
    def __init__(self):
        super().__init__("color_tracker")
        self.bridge = CvBridge()
        self.model = PinholeCameraModel()
        self.publisher = self.create_publisher(Vector3Stamped, "ray", 10)
        image_sub = message_filters.Subscriber(self, Image, "left/image_raw", qos_profile=qos_profile_sensor_data)
        info_sub = message_filters.Subscriber(self, CameraInfo, "left/camera_info", qos_profile=qos_profile_sensor_data)
        self.ts = message_filters.TimeSynchronizer([image_sub, info_sub], 10)
        self.ts.registerCallback(self.callback)
        self.done = False

    def callback(self, image, info):
        self.model.fromCameraInfo(info)
        hsv = cv2.cvtColor(self.bridge.imgmsg_to_cv2(image, "bgr8"), cv2.COLOR_BGR2HSV)
        mask = cv2.inRange(hsv, (0, 200, 200), (10, 255, 255))
        contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
        if not contours:
            return
        m = cv2.moments(max(contours, key=cv2.contourArea))
        x, y, z = self.model.projectPixelTo3dRay((m["m10"] / m["m00"], m["m01"] / m["m00"]))
        ray = Vector3Stamped(header=image.header)
        ray.vector.x, ray.vector.y, ray.vector.z = x, y, z
        self.publisher.publish(ray)
        u, v = self.model.project3dToPixel((x, y, z))
        self.get_logger().info(f"red at {u:.1f}, {v:.1f}")
        print("ray", image.header.frame_id, x > 0, abs(v - 59.5) < 0.1)
        self.done = True


rclpy.init()
node = ColorTracker()
while rclpy.ok() and not node.done:
    rclpy.spin_once(node)
rclpy.shutdown()
