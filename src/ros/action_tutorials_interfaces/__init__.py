"""ROS package action_tutorials_interfaces."""

from coframe.workspace import ros_side

ros_side.check("action_tutorials_interfaces")
