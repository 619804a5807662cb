"""ROS package rosgraph_msgs."""

from coframe import ros_side

ros_side.check("rosgraph_msgs")
