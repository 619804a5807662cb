"""ROS package example_interfaces."""

from coframe import ros_side

ros_side.check("example_interfaces")
