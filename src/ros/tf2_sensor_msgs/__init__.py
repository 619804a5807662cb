"""Sensor messages in tf2: point clouds seen from another frame.

Importing this package teaches `tf2_ros.Buffer.transform` the type `PointCloud2`.
"""

from coframe import ros_side

ros_side.check(__name__)


from tf2_sensor_msgs.tf2_sensor_msgs import do_transform_cloud, transform_points

__all__ = ["do_transform_cloud", "transform_points"]
