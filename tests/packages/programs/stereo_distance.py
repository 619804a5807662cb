# SPDX-License-Identifier: Apache-2.0
"""Measures the distance of an object with two cameras."""

import numpy as np

import rclpy
from cv_bridge import CvBridge
from image_geometry import StereoCameraModel
from message_filters import Subscriber, TimeSynchronizer
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import CameraInfo, Image

rclpy.init()
node = rclpy.create_node("stereo_distance")
bridge, model, distances = CvBridge(), StereoCameraModel(), []
qos = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)


def column(message):
    image = bridge.imgmsg_to_cv2(message, "rgb8")
    return np.nonzero(image[..., 0] > 200)[1].mean()


def callback(left, right, left_info, right_info):
    model.fromCameraInfo(left_info, right_info)
    disparity = column(left) - column(right)
    x, y, z = model.projectPixelTo3d((column(left), 60), disparity)
    distances.append((z, model.getZ(disparity)))


subscribers = [Subscriber(node, Image, f"{side}/image_raw", qos_profile=qos) for side in ("left", "right")]
subscribers += [Subscriber(node, CameraInfo, f"{side}/camera_info", qos_profile=qos) for side in ("left", "right")]
synchronizer = TimeSynchronizer(subscribers, 10)
synchronizer.registerCallback(callback)
while rclpy.ok() and not distances:
    rclpy.spin_once(node, timeout_sec=1.0)
print("distance", *[f"{d:.2f}" for d in distances[0]])
rclpy.shutdown()
