"""Transformation of markers."""

from copy import deepcopy

import tf2_ros
from geometry_msgs.msg import TransformStamped
from tf2_geometry_msgs import do_transform_pose
from visualization_msgs.msg import Marker


def do_transform_marker(marker: Marker, transform: TransformStamped) -> Marker:
    """Transform a marker. The result has the header of the transform.

    The pose is transformed. The points are expressed relative to the pose and do not change. A marker with
    `frame_locked` is then locked to the new frame, which is equivalent only if the two frames do not move relative to
    each other.
    """
    result = Marker()
    for field in marker.get_fields_and_field_types():
        value = getattr(marker, field)
        # Lists are copied shallowly, because a deep copy of thousands of points would be slow.
        setattr(result, field, list(value) if isinstance(value, list) else deepcopy(value))
    result.header = transform.header
    result.pose = do_transform_pose(marker.pose, transform)
    return result


tf2_ros.TransformRegistration().add(Marker, do_transform_marker)
