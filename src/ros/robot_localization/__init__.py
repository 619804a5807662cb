"""ROS package robot_localization."""

from coframe.workspace import ros_side

ros_side.check("robot_localization")
