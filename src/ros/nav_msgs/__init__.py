"""ROS package nav_msgs."""

from coframe import ros_side

ros_side.check("nav_msgs")
