"""ROS package map_msgs."""

from coframe import ros_side

ros_side.check("map_msgs")
