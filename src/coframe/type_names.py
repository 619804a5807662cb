# SPDX-License-Identifier: Apache-2.0
"""Names of message types that several parts of coframe use."""

from __future__ import annotations

from typing import Final

__all__ = [
    "CAMERA_INFO",
    "COMPRESSED_IMAGE",
    "IMAGE",
    "LASER_SCAN",
    "POINT_CLOUD",
    "TF_MESSAGE",
    "TF_MESSAGES_OF_ROS1",
    "is_tf_message",
]

TF_MESSAGE: Final = "tf2_msgs/msg/TFMessage"
# ROS 1 has two names for it; the second one is that of its first package.
TF_MESSAGES_OF_ROS1: Final = ("tf2_msgs/TFMessage", "tf/tfMessage")
POINT_CLOUD: Final = "sensor_msgs/msg/PointCloud2"
LASER_SCAN: Final = "sensor_msgs/msg/LaserScan"
IMAGE: Final = "sensor_msgs/msg/Image"
COMPRESSED_IMAGE: Final = "sensor_msgs/msg/CompressedImage"
CAMERA_INFO: Final = "sensor_msgs/msg/CameraInfo"


def is_tf_message(ros_type: str) -> bool:
    """Return whether a type name of ROS 1 or ROS 2 is the type of transform messages."""
    return ros_type.replace("/msg/", "/") in TF_MESSAGES_OF_ROS1
