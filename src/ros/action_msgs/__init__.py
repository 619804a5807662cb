"""ROS package action_msgs."""

from coframe import ros_side

ros_side.check("action_msgs")
