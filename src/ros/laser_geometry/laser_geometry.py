# SPDX-License-Identifier: Apache-2.0
"""Projection of laser scans to point clouds: LaserProjection."""

from typing import Any

import numpy as np

from coframe.sensors import project_scan
from sensor_msgs.msg import LaserScan, PointCloud2, PointField
from sensor_msgs_py import point_cloud2

__all__ = ["LaserProjection"]


class LaserProjection:
    """Converter from laser scans to point clouds in the frame of the scanner."""

    LASER_SCAN_INVALID = -1.0
    LASER_SCAN_MIN_RANGE = -2.0
    LASER_SCAN_MAX_RANGE = -3.0

    class ChannelOption:
        """Fields of the points in addition to x, y and z; several are combined with `|`."""

        NONE = 0x00
        INTENSITY = 0x01
        INDEX = 0x02
        DISTANCE = 0x04
        TIMESTAMP = 0x08
        VIEWPOINT = 0x10
        DEFAULT = INTENSITY | INDEX

    def projectLaser(
        self, scan_in: LaserScan, range_cutoff: float = -1.0, channel_options: int = ChannelOption.DEFAULT
    ) -> PointCloud2:
        """Return the points of a scan, in meters.

        Beams with a range that is NaN, below `range_min`, or not below the limit are skipped.

        Args:
            scan_in: The scan to project.
            range_cutoff: Limit of the range in meters. Negative, or above `range_max`: `range_max` is the limit.
            channel_options: The additional fields: `intensity` if the scan has any, the `index` of the beam, its range
                `distances`, the time `stamps` since the first beam in seconds, and the viewpoint `vp_x`, `vp_y`,
                `vp_z`, which is the origin.

        Returns:
            A cloud with the header of the scan.
        """
        scan = project_scan(scan_in)
        beams, points = scan.beams, scan.points
        ranges = np.asarray(scan_in.ranges, np.float32)[beams]
        if range_cutoff >= 0.0:
            near = ranges < range_cutoff
            beams, points, ranges = beams[near], points[near], ranges[near]
        option = self.ChannelOption
        columns = dict(zip("xyz", points.T, strict=True))
        if channel_options & option.INTENSITY and len(scan_in.intensities):
            columns["intensity"] = np.asarray(scan_in.intensities, np.float32)[beams]
        if channel_options & option.INDEX:
            columns["index"] = beams
        if channel_options & option.DISTANCE:
            columns["distances"] = ranges
        if channel_options & option.TIMESTAMP:
            columns["stamps"] = beams * scan_in.time_increment
        if channel_options & option.VIEWPOINT:
            columns.update(dict.fromkeys(("vp_x", "vp_y", "vp_z"), np.zeros(len(beams))))
        types: list[tuple[str, Any]] = [(name, "<i4" if name == "index" else "<f4") for name in columns]
        values = np.empty(len(beams), types)
        for name, column in columns.items():
            values[name] = column
        fields = [
            PointField(
                name=name,
                offset=4 * number,
                datatype=PointField.INT32 if name == "index" else PointField.FLOAT32,
                count=1,
            )
            for number, name in enumerate(columns)
        ]
        return point_cloud2.create_cloud(scan_in.header, fields, values)
