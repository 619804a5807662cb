"""ROS package control_msgs."""

from coframe.workspace import ros_side

ros_side.check("control_msgs")
