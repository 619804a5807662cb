"""ROS package map_msgs."""

from coframe.workspace import ros_side

ros_side.check("map_msgs")
