"""Markers seen from another frame."""

from copy import deepcopy

import tf2_ros
from geometry_msgs.msg import TransformStamped
from tf2_geometry_msgs import do_transform_pose
from visualization_msgs.msg import Marker


def do_transform_marker(marker: Marker, transform: TransformStamped) -> Marker:
    """A marker, drawn where it was, but told in the transform's frame; the header is the transform's.

    Its pose moves. Its points are told relative to the pose and stay, as do scale, colours, lifetime, ... A marker
    with `frame_locked` is from then on locked to the new frame: that is the same only where the two frames do not
    move against each other.
    """
    result = Marker()
    for field in marker.get_fields_and_field_types():
        value = getattr(marker, field)
        # Thousands of points are not copied one by one.
        setattr(result, field, list(value) if isinstance(value, list) else deepcopy(value))
    result.header = transform.header
    result.pose = do_transform_pose(marker.pose, transform)
    return result


tf2_ros.TransformRegistration().add(Marker, do_transform_marker)
