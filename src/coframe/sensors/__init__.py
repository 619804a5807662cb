"""Laser scans and point clouds, as messages and as arrays, seen from other frames.

`transform_cloud` moves a cloud as a whole, `deskew` each of its points by its own time; `project_scan` makes points of
a laser scan.
"""

from coframe.sensors.clouds import transform_cloud
from coframe.sensors.deskewing import deskew
from coframe.sensors.scans import ScanPoints, project_scan

__all__ = ["ScanPoints", "deskew", "project_scan", "transform_cloud"]
