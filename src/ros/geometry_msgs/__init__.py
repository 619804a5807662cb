"""ROS package geometry_msgs."""

from coframe import ros_side

ros_side.check("geometry_msgs")
