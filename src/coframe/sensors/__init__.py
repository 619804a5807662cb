# SPDX-License-Identifier: Apache-2.0
"""Transform laser scans and point clouds, as messages or arrays, to other frames.

`transform_cloud` transforms a cloud as a whole, `deskew` transforms each point at its own time, and `project_scan`
converts a laser scan to points, and `depth_points` a depth image.
"""

from coframe.sensors._deskewing import deskew
from coframe.sensors._scans import ScanPoints, project_scan
from coframe.sensors.clouds import transform_cloud
from coframe.sensors.depth_clouds import depth_points

__all__ = ["ScanPoints", "depth_points", "deskew", "project_scan", "transform_cloud"]


def __dir__() -> list[str]:
    return sorted(__all__)
