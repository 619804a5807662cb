"""Odometry seen from another frame."""

from copy import deepcopy

import tf2_ros
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from tf2_geometry_msgs import do_transform_pose, transform_covariance


def do_transform_odometry(odometry: Odometry, transform: TransformStamped) -> Odometry:
    """Odometry, seen from the transform's frame; the header is the transform's.

    The pose, which is told in the header's frame, moves, and its covariance is rotated. The twist and its covariance
    are told in `child_frame_id`, the robot's own frame, and stay.
    """
    result = deepcopy(odometry)
    result.header = transform.header
    result.pose.pose = do_transform_pose(odometry.pose.pose, transform)
    result.pose.covariance = transform_covariance(odometry.pose.covariance, transform)
    return result


tf2_ros.TransformRegistration().add(Odometry, do_transform_odometry)
