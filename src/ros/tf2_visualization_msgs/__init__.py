"""tf2 support for visualization messages: markers.

Importing this package registers the type `Marker` for `tf2_ros.Buffer.transform`. ROS has no such package. This one
only uses the API of ROS, so it also works with a sourced ROS installation.
"""

from tf2_visualization_msgs.marker import do_transform_marker

__all__ = ["do_transform_marker"]
