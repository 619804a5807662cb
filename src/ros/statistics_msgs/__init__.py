"""ROS package statistics_msgs."""

from coframe import ros_side

ros_side.check("statistics_msgs")
