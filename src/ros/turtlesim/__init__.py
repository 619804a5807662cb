"""ROS package turtlesim."""

from coframe.workspace import ros_side

ros_side.check("turtlesim")
