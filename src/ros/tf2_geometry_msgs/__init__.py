"""tf2 support for geometry messages: points, vectors, poses, twists, ...

Importing this package registers the stamped types for `tf2_ros.Buffer.transform`.
"""

from typing import Iterable, Optional, Tuple  # noqa: UP035 - leaked upstream

import numpy as np

import tf2_ros
from geometry_msgs.msg import (
    AccelStamped,
    AccelWithCovarianceStamped,
    InertiaStamped,
    Point,
    Point32,
    PointStamped,
    PolygonStamped,
    Pose,
    PoseArray,
    PoseStamped,
    PoseWithCovarianceStamped,
    QuaternionStamped,
    TransformStamped,
    TwistStamped,
    TwistWithCovarianceStamped,
    Vector3Stamped,
    WrenchStamped,
)
from tf2_geometry_msgs.rigid_body import (
    do_transform_accel_stamped,
    do_transform_accel_with_covariance_stamped,
    do_transform_inertia_stamped,
    do_transform_twist_stamped,
    do_transform_twist_with_covariance_stamped,
    do_transform_wrench_stamped,
)
from tf2_geometry_msgs.tf2_geometry_msgs import (
    do_transform_point,
    do_transform_polygon_stamped,
    do_transform_pose,
    do_transform_pose_array,
    do_transform_pose_stamped,
    do_transform_pose_with_covariance_stamped,
    do_transform_quaternion_stamped,
    do_transform_vector3,
    from_msg_msg,
    to_msg_msg,
    transform_covariance,
)

# The message types and other names are exported because programs import them from upstream's package.
__all__ = [
    "AccelStamped",
    "AccelWithCovarianceStamped",
    "InertiaStamped",
    "Iterable",
    "Optional",
    "Point",
    "Point32",
    "PointStamped",
    "PolygonStamped",
    "Pose",
    "PoseArray",
    "PoseStamped",
    "PoseWithCovarianceStamped",
    "QuaternionStamped",
    "TransformStamped",
    "Tuple",
    "TwistStamped",
    "TwistWithCovarianceStamped",
    "Vector3Stamped",
    "WrenchStamped",
    "do_transform_accel_stamped",
    "do_transform_accel_with_covariance_stamped",
    "do_transform_inertia_stamped",
    "do_transform_point",
    "do_transform_polygon_stamped",
    "do_transform_pose",
    "do_transform_pose_array",
    "do_transform_pose_stamped",
    "do_transform_pose_with_covariance_stamped",
    "do_transform_quaternion_stamped",
    "do_transform_twist_stamped",
    "do_transform_twist_with_covariance_stamped",
    "do_transform_vector3",
    "do_transform_wrench_stamped",
    "from_msg_msg",
    "np",
    "tf2_ros",
    "to_msg_msg",
    "transform_covariance",
]
