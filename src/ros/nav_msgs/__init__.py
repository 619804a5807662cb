"""ROS package nav_msgs."""

from coframe.workspace import ros_side

ros_side.check("nav_msgs")
