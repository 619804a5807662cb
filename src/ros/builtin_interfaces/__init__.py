"""ROS package builtin_interfaces."""

from coframe.workspace import ros_side

ros_side.check("builtin_interfaces")
