"""Visualization messages in tf2: markers seen from another frame.

Importing this package teaches `tf2_ros.Buffer.transform` the type `Marker`. ROS itself has no such package: this one
stands on ROS names only, and works on a sourced ROS, too.
"""

from tf2_visualization_msgs.marker import do_transform_marker

__all__ = ["do_transform_marker"]
