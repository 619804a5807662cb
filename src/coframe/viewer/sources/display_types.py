# SPDX-License-Identifier: Apache-2.0
"""The message types that the viewer can display."""

from __future__ import annotations

__all__ = ["DISPLAY_OF_TYPE"]

DISPLAY_OF_TYPE: dict[str, str] = {
    "geometry_msgs/msg/PoseArray": "PoseArray",
    "geometry_msgs/msg/PoseStamped": "Pose",
    "geometry_msgs/msg/PoseWithCovarianceStamped": "PoseWithCovariance",
    "nav_msgs/msg/OccupancyGrid": "Map",
    "nav_msgs/msg/Odometry": "Odometry",
    "nav_msgs/msg/Path": "Path",
    "sensor_msgs/msg/CameraInfo": "CameraInfo",
    "sensor_msgs/msg/CompressedImage": "Image",
    "sensor_msgs/msg/Image": "Image",
    "sensor_msgs/msg/LaserScan": "LaserScan",
    "sensor_msgs/msg/PointCloud2": "PointCloud2",
    "sensor_msgs/msg/Range": "Range",
    "visualization_msgs/msg/Marker": "Marker",
    "visualization_msgs/msg/MarkerArray": "MarkerArray",
}
"""RViz's display for each message type."""
