"""tf2 support for sensor messages: point clouds, laser scans and IMU data.

Importing this package registers the types `PointCloud2`, `LaserScan` and `Imu` for `tf2_ros.Buffer.transform`.
"""

from tf2_sensor_msgs.imu import do_transform_imu
from tf2_sensor_msgs.laser_scan import do_transform_laser_scan
from tf2_sensor_msgs.tf2_sensor_msgs import do_transform_cloud, transform_points

__all__ = ["do_transform_cloud", "do_transform_imu", "do_transform_laser_scan", "transform_points"]
