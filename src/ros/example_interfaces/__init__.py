"""ROS package example_interfaces."""

from coframe.workspace import ros_side

ros_side.check("example_interfaces")
