"""ROS package rcl_interfaces."""

from coframe import ros_side

ros_side.check("rcl_interfaces")
