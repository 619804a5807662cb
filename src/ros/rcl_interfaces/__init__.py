"""ROS package rcl_interfaces."""

from coframe.workspace import ros_side

ros_side.check("rcl_interfaces")
