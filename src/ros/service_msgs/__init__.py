"""ROS package service_msgs."""

from coframe.workspace import ros_side

ros_side.check("service_msgs")
