"""Messages as what the page can draw: one family a file.

Each drawing is told in a frame of its message and at the message's own stamp; where that frame was then is the viewer's
to find out (`coframe.viewer.displays.display`).
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

__all__ = ["DISPLAYS", "DRAWN_BY", "CannotDrawError", "Drawing", "Options"]

DRAWN_BY: dict[str, Callable[[Any, Options], Drawing]] = {
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
"""By type: what makes a drawing of each message alone."""

DISPLAYS: dict[str, str] = {
    "geometry_msgs/msg/PoseArray": "PoseArray",
    "geometry_msgs/msg/PoseStamped": "Pose",
    "geometry_msgs/msg/PoseWithCovarianceStamped": "PoseWithCovariance",
    "nav_msgs/msg/OccupancyGrid": "Map",
    "nav_msgs/msg/Odometry": "Odometry",
    "nav_msgs/msg/Path": "Path",
    "sensor_msgs/msg/CameraInfo": "Camera",
    "sensor_msgs/msg/CompressedImage": "Image",
    "sensor_msgs/msg/Image": "Image",
    "sensor_msgs/msg/LaserScan": "LaserScan",
    "sensor_msgs/msg/PointCloud2": "PointCloud2",
    "sensor_msgs/msg/Range": "Range",
    "visualization_msgs/msg/Marker": "Marker",
    "visualization_msgs/msg/MarkerArray": "MarkerArray",
}
"""By type: the display that RViz has for it."""
