"""ROS package turtlebot3_msgs."""

from coframe.workspace import ros_side

ros_side.check("turtlebot3_msgs")
