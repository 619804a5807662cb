"""Laser scans as points seen from another frame.

Upstream's Python does not have this. Which beams become points, and their fields, are those of `laser_geometry`.
"""

import tf2_ros
from coframe.sensors import project_scan
from geometry_msgs.msg import Transform, TransformStamped
from sensor_msgs.msg import LaserScan, PointCloud2
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
    return do_transform_cloud(project_scan(scan).to_cloud(), transform)


tf2_ros.TransformRegistration().add(LaserScan, do_transform_laser_scan)
