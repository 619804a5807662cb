"""ROS package builtin_interfaces."""

from coframe import ros_side

ros_side.check("builtin_interfaces")
