"""Laser scans as points seen from another frame.

Upstream's Python does not have this. Which beams become points, and their fields, are those of `laser_geometry`.
"""

import numpy as np
from numpy.typing import NDArray

import tf2_ros
from geometry_msgs.msg import Transform, TransformStamped
from sensor_msgs.msg import LaserScan, PointCloud2, PointField
from sensor_msgs_py.point_cloud2 import create_cloud, dtype_from_fields
from tf2_sensor_msgs.tf2_sensor_msgs import do_transform_cloud


def do_transform_laser_scan(scan: LaserScan, transform: Transform | TransformStamped) -> PointCloud2:
    """The points a scan has hit, seen from the transform's frame: a scan itself is a scan in its own plane only.

    Beams that hit nothing give no point: NaN, infinite, nearer than `range_min`, at `range_max` or beyond. All beams
    are taken as measured at the scan's stamp, which is the result's, too.

    Args:
        scan: The scan.
        transform: Its frame becomes the result's if it is stamped.

    Returns:
        A cloud with the float32 fields x, y, z in metres, the scan's intensities if it has any, and the int32 field
        `index`: the number of the beam.
    """
    ranges = np.asarray(scan.ranges, dtype=np.float64)
    hits = np.flatnonzero((ranges >= scan.range_min) & (ranges < scan.range_max))
    has_intensities = len(scan.intensities) == len(ranges) > 0
    fields = _fields(has_intensities=has_intensities)
    points = np.zeros(len(hits), dtype=dtype_from_fields(fields))
    points["x"], points["y"] = _in_plane(scan, ranges, hits)
    points["index"] = hits
    if has_intensities:
        points["intensity"] = np.asarray(scan.intensities)[hits]
    cloud = create_cloud(scan.header, fields, points)
    cloud.is_dense = True
    return do_transform_cloud(cloud, transform)


def _in_plane(scan: LaserScan, ranges: NDArray[np.float64], beams: NDArray[np.intp]) -> NDArray[np.float64]:
    """The ends of some beams in the scan's own frame, x and y. Shape (2, N)."""
    angles = scan.angle_min + beams * scan.angle_increment
    return np.stack((np.cos(angles), np.sin(angles))) * ranges[beams]


def _fields(*, has_intensities: bool) -> list[PointField]:
    numbers = ["x", "y", "z", *(["intensity"] if has_intensities else [])]
    fields = [
        PointField(name=name, offset=4 * position, datatype=PointField.FLOAT32, count=1)
        for position, name in enumerate(numbers)
    ]
    index = PointField(name="index", offset=4 * len(numbers), datatype=PointField.INT32, count=1)
    return [*fields, index]


tf2_ros.TransformRegistration().add(LaserScan, do_transform_laser_scan)
