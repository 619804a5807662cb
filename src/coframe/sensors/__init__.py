# SPDX-License-Identifier: Apache-2.0
"""Transform laser scans and point clouds, as messages or arrays, to other frames.

`transform_cloud` transforms a cloud as a whole, `deskew` transforms each point at its own time, and `project_scan`
converts a laser scan to points.
"""

from coframe.sensors._deskewing import deskew
from coframe.sensors._scans import ScanPoints, project_scan
from coframe.sensors.clouds import transform_cloud

__all__ = ["ScanPoints", "deskew", "project_scan", "transform_cloud"]


def __dir__() -> list[str]:
    return sorted(__all__)
