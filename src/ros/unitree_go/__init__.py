"""ROS package unitree_go."""

from coframe.workspace import ros_side

ros_side.check("unitree_go")
