"""tf2 support for navigation messages: odometry and paths.

Importing this package registers the types `Odometry` and `Path` for `tf2_ros.Buffer.transform`. ROS has no such
package. This one only uses the API of ROS, so it also works with a sourced ROS installation.
"""

from tf2_nav_msgs.odometry import do_transform_odometry
from tf2_nav_msgs.path import do_transform_path

__all__ = ["do_transform_odometry", "do_transform_path"]
