"""Navigation messages in tf2: odometry and paths seen from another frame.

Importing this package teaches `tf2_ros.Buffer.transform` the types `Odometry` and `Path`. ROS itself has no such
package: this one stands on ROS names only, and works on a sourced ROS, too.
"""

from tf2_nav_msgs.odometry import do_transform_odometry
from tf2_nav_msgs.path import do_transform_path

__all__ = ["do_transform_odometry", "do_transform_path"]
