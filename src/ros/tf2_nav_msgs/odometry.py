"""Transformation of odometry."""

from copy import deepcopy

import tf2_ros
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from tf2_geometry_msgs import do_transform_pose, transform_covariance


def do_transform_odometry(odometry: Odometry, transform: TransformStamped) -> Odometry:
    """Transform odometry. The result has the header of the transform.

    The pose, which is expressed in the frame of the header, is transformed, and its covariance is rotated. The twist
    and its covariance are expressed in `child_frame_id`, the frame of the robot, and do not change.
    """
    result = deepcopy(odometry)
    result.header = transform.header
    result.pose.pose = do_transform_pose(odometry.pose.pose, transform)
    result.pose.covariance = transform_covariance(odometry.pose.covariance, transform)
    return result


tf2_ros.TransformRegistration().add(Odometry, do_transform_odometry)
