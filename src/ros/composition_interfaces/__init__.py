"""ROS package composition_interfaces."""

from coframe import ros_side

ros_side.check("composition_interfaces")
