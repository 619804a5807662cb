"""ROS package turtlesim_msgs."""

from coframe.workspace import ros_side

ros_side.check("turtlesim_msgs")
