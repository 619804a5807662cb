"""ROS package controller_manager_msgs."""

from coframe.workspace import ros_side

ros_side.check("controller_manager_msgs")
