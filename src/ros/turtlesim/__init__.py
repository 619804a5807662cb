"""ROS package turtlesim."""

from coframe import ros_side

ros_side.check("turtlesim")
