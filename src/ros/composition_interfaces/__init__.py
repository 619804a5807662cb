"""ROS package composition_interfaces."""

from coframe.workspace import ros_side

ros_side.check("composition_interfaces")
