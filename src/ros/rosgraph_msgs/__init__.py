"""ROS package rosgraph_msgs."""

from coframe.workspace import ros_side

ros_side.check("rosgraph_msgs")
