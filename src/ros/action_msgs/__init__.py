"""ROS package action_msgs."""

from coframe.workspace import ros_side

ros_side.check("action_msgs")
