"""Transformation of laser scans into point clouds in another frame.

Upstream's Python package does not provide this function. The selection of beams and the fields of the points follow
`laser_geometry`.
"""

import tf2_ros
from coframe.sensors import project_scan
from geometry_msgs.msg import Transform, TransformStamped
from sensor_msgs.msg import LaserScan, PointCloud2
from tf2_sensor_msgs.tf2_sensor_msgs import do_transform_cloud


def do_transform_laser_scan(scan: LaserScan, transform: Transform | TransformStamped) -> PointCloud2:
    """Return the points of a scan in the target frame. A scan can only represent points in its own plane.

    Beams with a range that is NaN, infinite, below `range_min`, or not below `range_max` are skipped. All beams are
    treated as measured at the stamp of the scan, which is also the stamp of the result.

    Args:
        scan: Scan to transform.
        transform: Transform into the target frame. If it is stamped, the result has its frame_id.

    Returns:
        A cloud with the float32 fields x, y, z in meters, the intensities of the scan if it has any, and the int32
        field `index`, which is the index of the beam.
    """
    return do_transform_cloud(project_scan(scan).to_cloud(), transform)


tf2_ros.TransformRegistration().add(LaserScan, do_transform_laser_scan)
