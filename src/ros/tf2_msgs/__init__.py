"""ROS package tf2_msgs."""

from coframe import ros_side

ros_side.check("tf2_msgs")
