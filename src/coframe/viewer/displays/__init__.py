# SPDX-License-Identifier: Apache-2.0
"""Displays: messages converted to drawings, one module per family of message types.

A drawing is expressed in a frame of its message at the message's own stamp. `coframe.viewer.displays.display` looks up
the pose of that frame in the fixed frame.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.viewer.displays.drawing import CannotDrawError, Drawing, Options
from coframe.viewer.displays.grids import draw_grid
from coframe.viewer.displays.images import draw_compressed_image, draw_image
from coframe.viewer.displays.points import draw_cloud, draw_scan
from coframe.viewer.displays.shapes import draw_camera, draw_path, draw_pose, draw_pose_array, draw_range

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["DRAW_FUNCTIONS", "CannotDrawError", "Drawing", "Options"]

DRAW_FUNCTIONS: dict[str, Callable[[Any, Options], Drawing]] = {
    "geometry_msgs/msg/PoseArray": draw_pose_array,
    "geometry_msgs/msg/PoseStamped": draw_pose,
    "geometry_msgs/msg/PoseWithCovarianceStamped": draw_pose,
    "nav_msgs/msg/OccupancyGrid": draw_grid,
    "nav_msgs/msg/Path": draw_path,
    "sensor_msgs/msg/CameraInfo": draw_camera,
    "sensor_msgs/msg/CompressedImage": draw_compressed_image,
    "sensor_msgs/msg/Image": draw_image,
    "sensor_msgs/msg/LaserScan": draw_scan,
    "sensor_msgs/msg/PointCloud2": draw_cloud,
    "sensor_msgs/msg/Range": draw_range,
}
"""The function that draws a message, for types whose messages are drawn independently of each other."""
