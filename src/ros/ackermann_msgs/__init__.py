"""ROS package ackermann_msgs."""

from coframe.workspace import ros_side

ros_side.check("ackermann_msgs")
